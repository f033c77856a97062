// Restarts on a lathe: back over what the tool has passed, from a thread only at its beginning.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"

namespace dripline::gateway {
namespace {

using testing::HasSubstr;

class LatheRestart : public testing::Test {
 protected:
  LatheRestart() : shop(interpreter::kFanucLatheDialect, {}, "20x") {
    shop.set_checkpoint_interval(std::chrono::milliseconds(200));
  }
  /// Runs the program until X or Z is below that, and aborts it there.
  void abort_below(const std::string& program, std::size_t axis, double limit) {
    shop.push("P", program);
    shop.restart_gateway();
    ASSERT_TRUE(shop.start_program("P").accepted);
    run = shop.last_run();
    ASSERT_TRUE(shop.run_until([&] { return shop.status && shop.status->position[axis] < limit; }));
    ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
    ASSERT_TRUE(shop.run_on());
    ASSERT_EQ(shop.last_end().outcome, dds::RunOutcome::Aborted);
  }
  nlohmann::json restart(const std::string& at = "executed") {
    return shop.begin_restart("P", run, at);
  }
  /// Why there is none.
  std::string refusal(const std::string& at = "executed") {
    EXPECT_TRUE(restart(at).is_null());
    return shop.start_answer.accepted ? shop.last_end().reason : shop.start_answer.reason;
  }
  void complete() {
    ASSERT_TRUE(shop.cycle_start());
    ASSERT_TRUE(shop.run_on());
    EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Completed) << shop.last_end().reason;
  }

  RestartFixture shop;
  std::string run;
};

const std::string kPocket =
    "O0001\nG21 G40 G00 X200. Z150.\nT0101\nG97 S500 M03\nN10 G00 X50. Z-10.\n"
    "N20 G01 X30. Z-15. F0.2\nN30 Z-20.\nN40 X40. Z-30.\nN50 G00 X52.\nN60 X200. Z150.\nM30\n";

TEST_F(LatheRestart, GoesBackInAPocketOverWhatWasCut) {
  abort_below(kPocket, 2, -24);
  const auto report = restart();
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason << shop.last_end().reason;
  EXPECT_EQ(report["next"]["n"], 40);
  EXPECT_EQ(report["continues_at"], (nlohmann::json{{"X", 15}, {"Z", -20}}));
  ASSERT_EQ(report["approach"].size(), 2U) << report["approach"];
  EXPECT_EQ(report["approach"][0]["move"], "switch_on");
  EXPECT_EQ(report["approach"][1]["move"], "feed");
  EXPECT_EQ(report["approach"][1]["to"], (nlohmann::json{{"X", 15}, {"Z", -20}}));
  complete();
}

TEST_F(LatheRestart, GoesBackToAnEarlierBlockOverWhatWasCut) {
  abort_below(kPocket, 2, -24);
  const auto report = restart("N20");
  ASSERT_TRUE(report.is_object()) << shop.start_answer.reason << shop.last_end().reason;
  ASSERT_EQ(report["approach"].size(), 4U) << report["approach"];
  EXPECT_EQ(report["approach"][1]["to"], (nlohmann::json{{"X", 15}, {"Z", -20}}));
  EXPECT_EQ(report["approach"][2]["to"], (nlohmann::json{{"X", 15}, {"Z", -15}}));
  EXPECT_EQ(report["approach"][3]["to"], (nlohmann::json{{"X", 25}, {"Z", -10}}));
  complete();
}

/// In front of the part is beyond the wall of the pocket.
TEST_F(LatheRestart, IsRefusedFromWhereTheToolHasNotBeen) {
  abort_below(kPocket, 2, -24);
  shop.restart_gateway();  // the simulated axes are at their start again
  shop.path.clear();
  EXPECT_THAT(refusal(),
              testing::AllOf(HasSubstr("no path from there to X30.000 Z-20.000"),
                             HasSubstr("bring the tool there by hand or by MDI, or to X200.000 "
                                       "Z150.000, where the program took it up")));
  EXPECT_TRUE(shop.path.empty()) << "nothing was given to the machine";
}

TEST_F(LatheRestart, BeginsAThreadAtItsBeginning) {
  const std::string program =
      "O0001\nG21 G40 G00 X60. Z5.\nT0101\nG97 S500 M03\nN10 G00 X40.\nN20 G32 Z-20. F2.\n"
      "N30 X44. Z-90.\nN40 G00 X60.\nN50 Z5.\nM30\n";
  abort_below(program, 2, -25);
  EXPECT_THAT(refusal(), HasSubstr("the tool stopped in a thread"));
  shop.restart_gateway();  // its axes are elsewhere then: it was retracted
  const std::string why = refusal();
  EXPECT_THAT(why, HasSubstr("continues the thread that begins in block 6"));
  EXPECT_THAT(why, HasSubstr("restart there, block=6"));
  EXPECT_THAT(refusal("block=6"), HasSubstr("to X40.000 Z5.000, where the program continues"));
}

/// Each pass of a cycle begins where its block does.
TEST_F(LatheRestart, BeginsACycleOfThreadsAgain) {
  const std::string program =
      "O0001\nG21 G40 G00 X60. Z5.\nT0101\nG97 S500 M03\nN10 G76 P010060 Q100 R0.05\n"
      "N20 G76 X36. Z-30. P2000 Q500 F2.\nN30 G00 X60. Z5.\nM30\n";
  abort_below(program, 2, -10);
  EXPECT_THAT(refusal(), HasSubstr("the tool stopped in a thread"));
}

}  // namespace
}  // namespace dripline::gateway
