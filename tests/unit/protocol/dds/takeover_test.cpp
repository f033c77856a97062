// A gateway that may not take the place of the one before, which is silent or gone.
#include <atomic>
#include <set>

#include "network.hpp"

namespace dripline::dds::test {
namespace {

constexpr const char* kMachine = "lathe-1";

class Takeover : public Network {
 protected:
  Takeover() {
    server_ = open_server(
        [this](const Announce& announce) { return is_open_ || announce.session != kStranger; });
    first_ = open_gateway(kMachine, 1);
    EXPECT_EQ(server_->announces.take().value().session, 1U);
    stranger_ = open_gateway(kMachine, kStranger);
    EXPECT_EQ(server_->rivals.take(), true);
  }
  void lose_first() {
    first_.reset();
    EXPECT_EQ(server_->lost.take(), kMachine);
  }
  void write_status(TestGateway& gateway, std::uint64_t session) {
    Status status;
    status.machine = kMachine;
    status.session = session;
    EXPECT_TRUE(gateway.endpoint->write(status));
  }

  static constexpr std::uint64_t kStranger = 2;
  std::atomic<bool> is_open_ = false;
  std::unique_ptr<TestServer> server_;
  std::unique_ptr<TestGateway> first_, stranger_;
};

TEST_F(Takeover, LosesTheMachineInsteadOfTakingAStranger) {
  lose_first();
  write_status(*stranger_, kStranger);
  EXPECT_EQ(server_->announces.take(500ms), std::nullopt);
  EXPECT_EQ(server_->statuses.size(), 0U);
  is_open_ = true;
  server_->endpoint->look_again(kMachine);
  EXPECT_EQ(server_->announces.take().value().session, kStranger);
}

TEST_F(Takeover, IsOfTheFirstOneAgainWhenThatIsBack) {
  lose_first();
  first_ = open_gateway(kMachine, 3);
  EXPECT_EQ(server_->announces.take().value().session, 3U);
  write_status(*stranger_, kStranger);
  write_status(*first_, 3);
  EXPECT_EQ(server_->statuses.take().value().session, 3U);
}

/// Whether or not it is the machine's: a stop goes to it.
TEST_F(Takeover, SendsAStopToAStrangerToo) {
  ASSERT_EQ(stranger_->server.take(), true);
  lose_first();
  Command hold;
  hold.machine = kMachine;
  hold.id = "hold";
  hold.action = CommandAction::Hold;
  ASSERT_TRUE(server_->endpoint->write(hold));
  EXPECT_EQ(stranger_->commands.take(), hold);
}

}  // namespace
}  // namespace dripline::dds::test
