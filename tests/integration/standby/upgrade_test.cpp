// An upgrade of two servers while a machine runs (deploy/docs/operations.md, Upgrades): the standby
// is started again, the active one is drained and started again, and drained back. The machine is
// fed all the time.
#include <csignal>
#include <thread>

#include "tests/integration/standby/fed_machine.hpp"

namespace dripline::integration {
namespace {

using std::chrono::seconds;

class Upgrade : public FedMachineTest {
 protected:
  /// As a package does with the service: an orderly end, and another process.
  void restart(int server) {
    const auto before = shop_->server(server).pid();
    shop_->server(server).signal(SIGTERM);
    const auto status = shop_->server(server).wait(seconds(60));
    ASSERT_TRUE(status) << shop_->log(server);
    EXPECT_EQ(*status, 0) << shop_->log(server);
    shop_->start(server);
    EXPECT_NE(shop_->server(server).pid(), before);
    EXPECT_EQ(shop_->role(server), "standby") << shop_->log(server);
    ASSERT_TRUE(shop_->wait_for_standby()) << shop_->log(server);
  }
  void drain(int server) {
    const auto drained = test_support::run_to_end(
        {program_path("dnc"), "--state", shop_->state(server), "server", "drain"},
        shop_->folder() / "dnc.out");
    ASSERT_EQ(drained.status, 0) << drained.output;
    ASSERT_TRUE(shop_->wait_active(1 - server)) << shop_->log(1 - server);
    ASSERT_TRUE(shop_->wait_connected(1 - server)) << shop_->log(1 - server);
    ASSERT_TRUE(shop_->wait_for_standby()) << shop_->log(server);
    EXPECT_EQ(shop_->role(server), "standby");
  }
  void expect_fed(const char* step) const {
    const auto range = levels_->now();
    EXPECT_GT(range.samples, 0u) << step;
    EXPECT_FALSE(range.has_ended) << step << ": the run ended, the program is too short";
    EXPECT_GE(range.least * 2, full_) << step << ": the text at the gateway fell below half";
  }
  std::uint64_t full_ = 0;  ///< of the gateway's text
};

TEST_F(Upgrade, OfBothServersIsNotFeltByAMachineThatRuns) {
  constexpr std::uint64_t kLines = 3000;
  begin();
  const std::string id = begin_run(kLines);
  ASSERT_FALSE(HasFailure());
  full_ = levels_->now().most;
  levels_->reset();
  restart(1);
  expect_fed("the standby was started again");
  EXPECT_EQ(shop_->role(0), "active");
  drain(0);
  expect_fed("drained");
  restart(0);
  expect_fed("the one that was drained was started again");
  drain(1);
  expect_fed("drained back");
  restart(1);
  std::this_thread::sleep_for(seconds(1));  // until text flows again
  expect_fed("at the end");
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_EQ(shop_->active(), 0);
  for (const int server : {0, 1})
    EXPECT_EQ(shop_->log(server).find("its lease ran out"), std::string::npos) << "handed over";
  expect_whole_run(0, id, kLines, seconds(240));
}

}  // namespace
}  // namespace dripline::integration
