// How high the approach of a restart goes, and what the height is taken from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"

namespace dripline::gateway {
namespace {

using Json = nlohmann::json;

/// A simulated mill whose runs begin at Z50.
class ApproachHeight : public testing::Test {
 protected:
  explicit ApproachHeight(double height = 50) {
    interpreter::Setup setup;
    setup.start.set(interpreter::Axis::Z, Length::mm(height));
    shop.emplace(interpreter::kFanucDialect, setup, "20x");
  }
  /// Aborts it at its stop.
  void abort_at_stop(const std::string& text) {
    shop->push("P", text);
    shop->restart_gateway();
    ASSERT_TRUE(shop->start_program("P").accepted);
    run = shop->last_run();
    ASSERT_TRUE(shop->run_until(
        [&] { return shop->status && shop->status->execution == dds::Execution::ProgramStopped; }));
    ASSERT_TRUE(shop->send(shop->command(dds::CommandAction::Abort)).accepted);
    ASSERT_TRUE(shop->run_on());
  }
  Json restart(const std::string& at) { return shop->begin_restart("P", run, at); }

  std::optional<RestartFixture> shop;
  std::string run;
};

/// The retraction at the program's head moves nothing.
TEST_F(ApproachHeight, IsThatWhereTheRunBegan) {
  abort_at_stop(
      "O0200\nG21 G90\nM03 S1000\nG00 Z50.\nX0 Y0\nG01 Z-5. F900\nN40 X60.\nY60.\nM00\n"
      "X0\nY0\nG00 Z50.\nM30\n");
  const auto report = restart("N40");
  ASSERT_TRUE(report.is_object()) << shop->start_answer.reason << shop->last_end().reason;
  EXPECT_EQ(report["position"], (Json{{"X", 60}, {"Y", 60}, {"Z", -5}}));
  EXPECT_EQ(report["approach"][0]["to"], (Json{{"Z", 50}})) << report["approach"];
  EXPECT_EQ(report["approach"][1]["to"], (Json{{"X", 0}, {"Y", 0}}));
}

/// Its ends are in the groove, and its middle is above the part.
TEST_F(ApproachHeight, IsThatOfTheTopOfAnArc) {
  abort_at_stop(
      "O0201\nG21 G90 G00 X0 Y0 Z-5.\nN40 G01 X10. F900\nG18 G03 X130. I60. K0\nG17 "
      "G01 Z-6.\nM00\nX150.\nM30\n");
  const auto report = restart("N40");
  ASSERT_TRUE(report.is_object()) << shop->start_answer.reason << shop->last_end().reason;
  EXPECT_EQ(report["approach"][0]["to"], (Json{{"Z", 55}})) << report["approach"];
}

/// The simulated machine is placed when the run begins, and not where it was before.
TEST_F(ApproachHeight, IsNotThatBeforeTheRun) {
  shop->push("Q", "O0203\nG21 G90 G00 X0 Y-25. Z90.\nM30\n");
  shop->restart_gateway();
  ASSERT_TRUE(shop->start_program("Q").accepted);
  ASSERT_TRUE(shop->run_on());
  ASSERT_EQ(shop->last_end().outcome, dds::RunOutcome::Completed);
  shop->push("P", "O0202\nG21 G90 M03 S900\nG01 Z-5. F900\nN40 X60.\nM00\nX80.\nM30\n");
  ASSERT_TRUE(shop->start_program("P").accepted);
  run = shop->last_run();
  ASSERT_TRUE(shop->run_until(
      [&] { return shop->status && shop->status->execution == dds::Execution::ProgramStopped; }));
  EXPECT_EQ(shop->status->position[1], 0);
  ASSERT_TRUE(shop->send(shop->command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop->run_on());
  const auto report = restart("N40");
  ASSERT_TRUE(report.is_object()) << shop->start_answer.reason << shop->last_end().reason;
  EXPECT_EQ(report["continues_at"].value("Y", 0.0), 0) << "the cut was at Y0";
  EXPECT_EQ(report["approach"][0]["to"], (Json{{"Z", 50}})) << report["approach"];
}

constexpr const char* kCutsAtOneHeight =
    "O0210\nG21 G90 M03 S900\nG01 X20. F60\nN30 X60.\nN40 Y30.\nM00\nX0\nM30\n";

/// Its axes begin at Z-5, in the part.
class FlatProgram : public ApproachHeight {
 protected:
  FlatProgram() : ApproachHeight(-5) {}
  void abort_at_stop(const std::string& text) {
    ApproachHeight::abort_at_stop(text);
    shop->path.clear();
  }
  void key_in(const std::string& text) {
    shop->push("MDI", text);
    dds::Command command = shop->start_command("MDI");
    command.argument = dds::kMdiStart;
    const std::size_t ended = shop->count(dds::RecordKind::RunEnded);
    ASSERT_TRUE(shop->send(command).accepted);
    ASSERT_TRUE(shop->run_until([&] {
      return shop->count(dds::RecordKind::RunEnded) > ended && shop->gateway->status().run.empty();
    }));
    shop->path.clear();
  }
};

TEST_F(FlatProgram, IsLeftToTheOperatorWithThePlace) {
  abort_at_stop(kCutsAtOneHeight);
  EXPECT_TRUE(restart("N30").is_null());
  EXPECT_THAT(shop->last_end().reason,
              testing::HasSubstr("the axes are at X60.000 Y30.000, and no height is known to be "
                                 "clear for a move from there to X20.000 Y0.000"));
  EXPECT_THAT(shop->last_end().reason,
              testing::HasSubstr("Bring the axes to X20.000 Y0.000 by hand or by MDI"));
  EXPECT_TRUE(shop->path.empty()) << "nothing was given to the machine";
}

/// Within what the axes of one machine report as the same place.
TEST_F(FlatProgram, ContinuesWhenTheAxesWereBroughtToThePlace) {
  abort_at_stop(kCutsAtOneHeight);
  key_in("G21 G00 X20.001 Y0");
  const auto report = restart("N30");
  ASSERT_TRUE(report.is_object()) << shop->start_answer.reason << shop->last_end().reason;
  ASSERT_TRUE(shop->cycle_start());
  ASSERT_TRUE(shop->run_on());
  EXPECT_EQ(shop->last_end().outcome, dds::RunOutcome::Completed) << shop->last_end().reason;
}

/// Back along what the interrupted move has cut, at its feed.
TEST_F(FlatProgram, GoesBackInTheMoveThatWasCutOff) {
  shop->push("P", kCutsAtOneHeight);
  shop->restart_gateway();
  ASSERT_TRUE(shop->start_program("P").accepted);
  run = shop->last_run();
  ASSERT_TRUE(shop->run_until([&] { return shop->status && shop->status->position[0] > 30; }));
  ASSERT_TRUE(shop->send(shop->command(dds::CommandAction::Abort)).accepted);
  ASSERT_TRUE(shop->run_on());
  const auto report = restart("executed");
  ASSERT_TRUE(report.is_object()) << shop->start_answer.reason << shop->last_end().reason;
  EXPECT_EQ(report["next"]["n"], 30);
  ASSERT_EQ(report["approach"].size(), 2U) << report["approach"];
  EXPECT_EQ(report["approach"][1]["move"], "feed");
  EXPECT_EQ(report["approach"][1]["to"]["X"], 20);
}

/// The rapid was beside the part.
TEST_F(FlatProgram, IsNotLedAcrossAtTheHeightOfItsCuts) {
  abort_at_stop("O0212\nG21 G90\nG00 X-20.\nN30 G01 X60. F900\nN40 Y30.\nM00\nX0\nM30\n");
  EXPECT_TRUE(restart("N30").is_null());
  EXPECT_THAT(shop->last_end().reason, testing::HasSubstr("no height is known to be clear"));
}

/// A TNC 155's programs have F9999 for rapid traverse.
TEST(TncHeight, IsClearAfterRapidTraverseByFeed) {
  interpreter::Setup setup;
  setup.start.set(interpreter::Axis::Z, Length::mm(20));
  const auto restart_after = [&](const std::string& positioning) {
    RestartFixture shop(interpreter::kTnc155Dialect, setup, "20x");
    shop.push("P", "0 BEGIN PGM 7 MM\n1 L X+10 R0 F" + positioning +
                       "\n2 L Z-5 R0 F900\n3 L X+60 R0 F900\n4 L Y+60\n5 STOP\n6 L X+0\n"
                       "7 END PGM 7 MM\n");
    shop.restart_gateway();
    EXPECT_TRUE(shop.start_program("P").accepted);
    const std::string run = shop.last_run();
    EXPECT_TRUE(shop.run_until(
        [&] { return shop.status && shop.status->execution == dds::Execution::ProgramStopped; }));
    EXPECT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
    EXPECT_TRUE(shop.run_on());
    return shop.begin_restart("P", run, "L4");
  };
  const auto report = restart_after("9999");
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["approach"][0]["to"]["Z"], 20) << report["approach"];
  EXPECT_TRUE(restart_after("2000").is_null()) << "only cuts led across";
}

}  // namespace
}  // namespace dripline::gateway
