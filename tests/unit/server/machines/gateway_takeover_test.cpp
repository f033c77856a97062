// Another gateway than the one before, while a run may be in progress.
#include "server/machines/machine_registry.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

constexpr std::uint64_t kOtherEpoch = 8;

class GatewayTakeover : public MachineServiceTest {
 protected:
  void SetUp() override {
    push("O0100", "M30\n");
    start_service();
    announce();
    answer_commands(true);
  }
  bool may_serve(std::uint64_t epoch) {
    dds::Announce announce;
    announce.machine = "lathe-1";
    announce.epoch = epoch;
    announce.version = "0.1.0";
    return network_.may_serve(announce);
  }
  std::vector<std::string> notices() { return machines::notices_of(*service_->machine("lathe-1")); }
};

TEST_F(GatewayTakeover, IsItsOwnMatterWhileNothingRuns) {
  EXPECT_TRUE(may_serve(kOtherEpoch));
  EXPECT_TRUE(notices().empty());
}

TEST_F(GatewayTakeover, WaitsForAPersonWhileARunMayBeInProgress) {
  ASSERT_TRUE(start("O0100"));
  EXPECT_TRUE(may_serve(kEpoch)) << "the same one after a restart";
  network_.on_lost("lathe-1");
  EXPECT_FALSE(may_serve(kOtherEpoch));
  ASSERT_EQ(notices().size(), 1U);
  EXPECT_NE(notices()[0].find("another gateway (version 0.1.0) claims to be this machine"),
            std::string::npos)
      << notices()[0];
  EXPECT_TRUE(wait_notified(machines_, [](const auto& view) { return view.unconfirmed_gateway; }));
  ASSERT_TRUE(service_->confirm_gateway("lathe-1"));
  EXPECT_TRUE(may_serve(kOtherEpoch));
  EXPECT_TRUE(notices().empty());
  EXPECT_EQ(service_->confirm_gateway("lathe-1").error().code, Errc::Conflict);
}

TEST_F(GatewayTakeover, IsConfirmedForTheOneThatWasSeen) {
  ASSERT_TRUE(start("O0100"));
  EXPECT_FALSE(may_serve(kOtherEpoch));
  ASSERT_TRUE(service_->confirm_gateway("lathe-1"));
  EXPECT_FALSE(may_serve(kOtherEpoch + 1));
}

TEST_F(GatewayTakeover, IsNoMatterAnyMoreWhenTheOtherOneHasLeft) {
  ASSERT_TRUE(start("O0100"));
  EXPECT_FALSE(may_serve(kOtherEpoch));
  network_.on_rival("lathe-1", false);
  EXPECT_TRUE(notices().empty());
}

TEST_F(GatewayTakeover, IsNoObstacleForAStop) {
  ASSERT_TRUE(start("O0100"));
  network_.on_lost("lathe-1");
  machines::CommandRequest request;
  request.machine = "lathe-1";
  request.action = dds::CommandAction::Hold;
  EXPECT_EQ(service_->command(request).error().code, Errc::Timeout) << "there is none";
  EXPECT_FALSE(may_serve(kOtherEpoch));
  EXPECT_TRUE(service_->command(request));
  request.action = dds::CommandAction::Resume;
  EXPECT_EQ(service_->command(request).error().code, Errc::Timeout);
}

}  // namespace
}  // namespace dripline::server_test
