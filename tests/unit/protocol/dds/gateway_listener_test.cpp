// Which gateways a server that only listens hears.
#include "protocol/dds/gateway_listener.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>

#include "protocol/dds/configuration.hpp"
#include "tests/support/announcement_bytes.hpp"
#include "tests/support/child_process.hpp"

namespace dripline::dds {
namespace {

using namespace std::chrono_literals;

SteadyTime moment(std::chrono::milliseconds time) {
  return SteadyTime(time);
}

ParticipantAnnouncement::Prefix numbered_prefix(int number) {
  ParticipantAnnouncement::Prefix made{};
  made[0] = static_cast<std::byte>(number & 0xFF);
  made[1] = static_cast<std::byte>(number >> 8);
  return made;
}

TEST(HeardGateways, CountsThoseThatAreHeardForALease) {
  HeardGateways heard(2s);
  for (auto time = 0ms; time < 2000ms; time += 250ms) {
    heard.note(numbered_prefix(1), moment(time));
    EXPECT_EQ(heard.count(moment(time)), 0u) << "it may only begin: " << time.count();
  }
  heard.note(numbered_prefix(1), moment(2000ms));
  EXPECT_EQ(heard.count(moment(2000ms)), 1u);
  EXPECT_EQ(heard.count(moment(4000ms)), 1u);
  EXPECT_EQ(heard.count(moment(4001ms)), 0u) << "silent for more than a lease";
}

TEST(HeardGateways, BeginsAgainAfterAGap) {
  HeardGateways heard(2s);
  heard.note(numbered_prefix(1), moment(0ms));
  heard.note(numbered_prefix(1), moment(2001ms));
  EXPECT_EQ(heard.count(moment(2001ms)), 0u);
  heard.note(numbered_prefix(1), moment(4001ms));
  EXPECT_EQ(heard.count(moment(4001ms)), 1u);
}

TEST(HeardGateways, AFloodOfNamesTakesNoMoreRoomThanMachinesMay) {
  HeardGateways heard(2s);
  for (auto time : {0ms, 2000ms})
    for (int i = 0; i < 10'000; ++i) heard.note(numbered_prefix(i), moment(time));
  EXPECT_EQ(heard.count(moment(2000ms)), kMaxMachines);
}

class GatewayListenerTest : public testing::Test {
 protected:
  void SetUp() override {
    options_.port = 21000;
    options_.tag = "listener-" + std::to_string(::getpid());
    options_.discovery_interval_ms = 50;
    options_.lease_ms = 500;
    while (!(listener_ = open()) && options_.port < 30000)
      options_.port = static_cast<std::uint16_t>(options_.port + 2 * kFewestCells);
    ASSERT_TRUE(listener_);
  }
  std::unique_ptr<GatewayListener> open() const {
    auto opened = GatewayListener::open(options_);
    return opened ? *std::move(opened) : nullptr;
  }
  bool hears(std::size_t gateways) {
    return test_support::eventually([&] {
      const auto now = std::chrono::steady_clock::now();
      listener_->receive(now);
      return listener_->count(now) == gateways;
    });
  }
  Result<std::unique_ptr<GatewayEndpoint>> start(const std::string& machine,
                                                 const std::string& tag) const {
    NetworkOptions options = options_;
    options.port = 0;
    options.tag = tag;
    options.server = fmt::format("127.0.0.1:{}", options_.port);
    return GatewayEndpoint::open(options, machine, {});
  }

  NetworkOptions options_;
  std::unique_ptr<GatewayListener> listener_;
};

TEST_F(GatewayListenerTest, HearsGatewaysThatNameItsPortsUntilTheyEnd) {
  auto first = start("mill-1", options_.tag), second = start("mill-2", options_.tag);
  ASSERT_TRUE(first) << first.error().what;
  ASSERT_TRUE(second) << second.error().what;
  EXPECT_TRUE(hears(2)) << "each in its own cell";
  first->reset();
  EXPECT_TRUE(hears(1));
}

TEST_F(GatewayListenerTest, DoesNotCountThoseOfAnotherSystem) {
  auto other = start("mill-1", "other"), own = start("mill-2", options_.tag);
  ASSERT_TRUE(other) << other.error().what;
  ASSERT_TRUE(own) << own.error().what;
  EXPECT_TRUE(hears(1));
  own->reset();
  EXPECT_TRUE(hears(0)) << "the other one is heard as long";
}

TEST_F(GatewayListenerTest, ItsPortsAreInUseForEveryoneElse) {
  const auto second = GatewayListener::open(options_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  EXPECT_FALSE(check_ports(options_));
  EXPECT_TRUE(check_second_ports(options_));
  listener_.reset();
  EXPECT_TRUE(check_ports(options_));
}

}  // namespace
}  // namespace dripline::dds
