#include <gtest/gtest.h>

#include "tests/support/child_process.hpp"
#include "tests/support/line/faulty_channel.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/unit/protocol/serial/line_fixture.hpp"
#include "tests/unit/protocol/serial/tcp_peer.hpp"

/// Pulled cables, vanished adapters, restarted device servers.
namespace dripline::serial {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;
using test_support::Pty;

TEST(LostLine, IsDetectedAndReopenedWhenThePortIsBack) {
  Pty pty;
  LineLog log;
  const auto line = start_toy(log, pty.path());
  ASSERT_TRUE(log.wait_open());
  EXPECT_TRUE(line->is_open());
  pty.unplug();
  ASSERT_TRUE(log.wait([&] { return log.channel.size() >= 2; }));
  EXPECT_NE(log.channel[1].find("hung up"), std::string::npos) << log.channel[1];
  EXPECT_FALSE(line->is_open());
  pty.plug_in();
  ASSERT_TRUE(log.wait_open(2));
  send(*line, "G0 X1\n");
  EXPECT_EQ(pty.read(6), "G0 X1\n");
}

TEST(LostLine, ReportsEachReasonOnce) {
  Pty pty;
  pty.unplug();
  LineLog log;
  const auto line = start_toy(log, pty.path());
  ASSERT_TRUE(log.wait([&] { return log.channel.size() == 1; }));
  EXPECT_NE(log.channel[0].find("no such device"), std::string::npos);
  EXPECT_FALSE(log.wait([&] { return log.channel.size() > 1; }, 200ms));
}

/// Which accepts and ends each connection at once.
TEST(LostLine, IsSteadyOnlyWhenADeviceServerKeepsTheConnection) {
  TcpPeer peer;
  LineLog log;
  const auto line = start_toy(log, peer.address());
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(peer.accept());
    peer.hang_up();
    ASSERT_TRUE(log.wait([&] { return log.channel.size() >= 2u * static_cast<unsigned>(i + 1); }));
  }
  EXPECT_FALSE(log.wait([&] { return log.steady_calls > 0; }, 50ms));
  ASSERT_TRUE(peer.accept());
  EXPECT_TRUE(log.wait([&] { return log.steady_calls == 1; }));
  EXPECT_FALSE(log.wait([&] { return log.steady_calls > 1; }, 500ms)) << "once for each opening";
}

TEST(LostLine, FailsAnUncheckedTransferAndSendsNothingOfItLater) {
  Pty pty;
  LineLog log;
  const auto line = start_toy(log, pty.path(), 9600);
  send(*line, std::string(4000, 'X'));
  ASSERT_EQ(pty.read(10).substr(0, 10), std::string(10, 'X'));
  pty.unplug();
  ASSERT_TRUE(log.wait([&] { return log.failures.size() == 1; }));
  EXPECT_EQ(log.failures[0].code, Errc::Io);
  pty.plug_in();
  ASSERT_TRUE(log.wait_open(2));
  send(*line, "END");
  EXPECT_EQ(pty.read(3), "END");
}

TEST(LostLine, FailsACheckedTransferThatWouldWaitWithoutEnd) {
  Pty pty;
  LineLog log;
  const auto settings = wire::find_template("tnc155-bcc").value()->settings;
  const auto line = LineDriver::start({pty.path(), settings, wire::Role::Host, log.listener()});
  ASSERT_TRUE(line);
  ASSERT_TRUE(log.wait_open());
  (*line)->post(
      [](wire::Discipline& end, wire::LineTime now) { EXPECT_TRUE(end.begin_send("7", now)); });
  ASSERT_TRUE(eventually([&] { return (*line)->state().may_wait_without_limit; }, 5s));
  pty.unplug();
  ASSERT_TRUE(log.wait([&] { return log.failures.size() == 1; }));
  EXPECT_EQ(log.failures[0].code, Errc::Io);
}

TEST(LostLine, FollowsARestartedDeviceServer) {
  LineLog log;
  std::optional<TcpPeer> peer(std::in_place);
  const std::uint16_t port = peer->port();
  const auto line = start_toy(log, peer->address());
  ASSERT_TRUE(peer->accept());
  ASSERT_TRUE(log.wait_open());
  peer.reset();
  ASSERT_TRUE(log.wait([&] { return log.channel.size() >= 2; }));
  ASSERT_TRUE(eventually([&] { return peer.emplace(port).is_listening(); }, 5s));
  ASSERT_TRUE(peer->accept());
  ASSERT_TRUE(log.wait_open(2));
  send(*line, "G0\n");
  EXPECT_EQ(peer->read(3), "G0\n");
}

TEST(LostLine, WaitsForAPortThatAnotherHasAndNamesTheOwner) {
  Pty pty;
  auto other = open_channel(pty.path(), {}, 1s);
  ASSERT_TRUE(other);
  LineLog log;
  const auto line = start_toy(log, pty.path());
  ASSERT_TRUE(log.wait([&] { return log.channel.size() == 1; }));
  EXPECT_NE(log.channel[0].find("in use by serial_test (pid " + std::to_string(::getpid()) + ")"),
            std::string::npos)
      << log.channel[0];
  other->reset();
  EXPECT_TRUE(log.wait_open());
}

}  // namespace
}  // namespace dripline::serial
