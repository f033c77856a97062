#include "protocol/process/service_manager.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cstdlib>

#include "tests/support/service_socket.hpp"

namespace dripline::process {
namespace {

using namespace std::chrono_literals;

/// The variables that systemd sets, for the time of a test.
class ServiceManager : public testing::Test {
 protected:
  ~ServiceManager() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
  }
  static void set(const char* name, const std::string& value) {
    ::setenv(name, value.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): one thread
  }
  void listen() { set("NOTIFY_SOCKET", socket_.path()); }

  test_support::ServiceSocket socket_;
};

TEST_F(ServiceManager, IsToldWhatADaemonDoes) {
  listen();
  EXPECT_TRUE(has_service_manager());
  notify_ready("dncd at http://127.0.0.1:8430");
  EXPECT_EQ(socket_.receive(), "READY=1\nSTATUS=dncd at http://127.0.0.1:8430");
  notify_alive("mill-7 ready");
  EXPECT_EQ(socket_.receive(), "WATCHDOG=1\nSTATUS=mill-7 ready");
  notify_stopping();
  EXPECT_EQ(socket_.receive(), "STOPPING=1");
}

/// A status holds texts of programs: it must stay one line, or it would set other fields.
TEST_F(ServiceManager, GetsOneLineOfStatus) {
  listen();
  notify_ready("alarm 5\nMAINPID=1");
  EXPECT_EQ(socket_.receive(), "READY=1\nSTATUS=alarm 5 MAINPID=1");
}

TEST_F(ServiceManager, IsNotNeeded) {
  EXPECT_FALSE(has_service_manager());
  notify_ready("no one listens");
  EXPECT_EQ(alive_interval(), std::nullopt);
  set("NOTIFY_SOCKET", "/nowhere/at/all");
  notify_alive("nor here");
  EXPECT_EQ(socket_.receive(10ms), std::nullopt);
}

TEST_F(ServiceManager, WantsToHearAtHalfItsLimit) {
  set("WATCHDOG_USEC", "30000000");
  EXPECT_EQ(alive_interval(), 15s);
  set("WATCHDOG_PID", std::to_string(::getpid() + 1));
  EXPECT_EQ(alive_interval(), std::nullopt) << "meant for another process";
}

}  // namespace
}  // namespace dripline::process
