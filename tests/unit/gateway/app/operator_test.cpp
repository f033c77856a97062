#include <gtest/gtest.h>
#include <cmath>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// What the operator of a Centurion lathe does at the panel while a program runs.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RunOutcome;

constexpr double kInch = 25.4;

interpreter::Setup setup_of(const std::string& toml) {
  auto setup = interpreter::parse_setup(toml, interpreter::Units::Inch);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

class LatheFixture : public GatewayFixture {
 public:
  explicit LatheFixture(const std::string& setup_toml = "", const std::string& speed = "1x")
      : GatewayFixture(interpreter::kCenturionDialect, setup_of(setup_toml), speed) {}

  dds::CommandResult give(CommandAction action, double value, const std::string& argument = "") {
    dds::Command asked = command(action);
    asked.value = value;
    asked.argument = argument;
    return send(asked);
  }
  double x() const { return status->position[0] / kInch; }
  double z() const { return status->position[2] / kInch; }
};

/// CEN-052, CEN-094.
TEST(Panel, OverridesHaveThePositionsOfTheControlsSwitches) {
  LatheFixture fixture;
  for (const double percent : {0, 10, 90, 130, 175})
    EXPECT_TRUE(fixture.give(CommandAction::SpindleOverride, percent / 100).accepted) << percent;
  for (const double percent : {5, 140, 150, 180})
    EXPECT_FALSE(fixture.give(CommandAction::SpindleOverride, percent / 100).accepted) << percent;
  EXPECT_EQ(fixture.give(CommandAction::SpindleOverride, 1.4).reason,
            "140 %: this control's switch has the positions 0 10 20 30 40 50 60 70 80 90 100 110 "
            "120 130 175 %");
  EXPECT_TRUE(fixture.give(CommandAction::FeedOverride, 1.5).accepted);
  EXPECT_FALSE(fixture.give(CommandAction::FeedOverride, 1.6).accepted);
  EXPECT_FALSE(fixture.give(CommandAction::FeedOverride, 0.75).accepted);
}

TEST(Panel, OverridesOfOtherControlsKeepTheirRange) {
  GatewayFixture fixture;
  dds::Command command = fixture.command(CommandAction::SpindleOverride);
  command.value = 1.3;
  EXPECT_EQ(fixture.send(command).reason, "130 %: expected 50 to 120 %");
  command = fixture.command(CommandAction::SpindleOverride);
  command.value = 1.2;
  EXPECT_TRUE(fixture.send(command).accepted);
}

/// CEN-217.
TEST(Panel, TablesOfTheSetupTakeThePlaceOfTheUsualOnes) {
  LatheFixture fixture(
      "[control]\nfeed_overrides = [0, 33, 199]\nspindle_overrides = [100, 255]\n");
  EXPECT_TRUE(fixture.give(CommandAction::FeedOverride, 1.99).accepted);
  EXPECT_TRUE(fixture.give(CommandAction::FeedOverride, 0.33).accepted);
  EXPECT_FALSE(fixture.give(CommandAction::FeedOverride, 0.5).accepted);
  EXPECT_TRUE(fixture.give(CommandAction::SpindleOverride, 2.55).accepted);
  EXPECT_FALSE(fixture.give(CommandAction::SpindleOverride, 1.1).accepted);
}

/// CEN-224: 400 pulses pass .01 minute, so a click of 10 pulses at 100 % passes 15 ms: at 20 inches
/// per minute 0.005 inch.
TEST(Handwheel, DrivesAProgramByClicks) {
  LatheFixture fixture("[control]\ncranking_minutes = 0.01\n");
  fixture.push("O1", "O1\nG20 G98 F20\nG1 Z-4\nM30\n");
  EXPECT_FALSE(fixture.give(CommandAction::Handwheel, 10).accepted) << "no run";
  ASSERT_TRUE(fixture.give(CommandAction::Switch, 1, "handwheel").accepted);
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status->message == "driven by the handwheel"; }));
  EXPECT_EQ(fixture.z(), 0);
  EXPECT_FALSE(fixture.give(CommandAction::Handwheel, -5).accepted) << "forward only";
  EXPECT_FALSE(fixture.give(CommandAction::Handwheel, 0.5).accepted);
  ASSERT_TRUE(fixture.give(CommandAction::Handwheel, 200).accepted);  // 3 seconds, 1 inch
  ASSERT_TRUE(fixture.run_until([&] { return fixture.z() < -0.99; }));
  (void)fixture.run_until([&] { return fixture.status->feed_mm_per_min == 0; });
  EXPECT_NEAR(fixture.z(), -1, 0.002) << "the ramp up costs v^2/2a = 0.0014";
  ASSERT_TRUE(fixture.give(CommandAction::FeedOverride, 0.5).accepted);  // 5 pulses a click
  ASSERT_TRUE(fixture.give(CommandAction::Handwheel, 200).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.z() < -1.49; }));
  (void)fixture.run_until([&] { return fixture.status->feed_mm_per_min == 0; });
  EXPECT_NEAR(fixture.z(), -1.5, 0.002);
  ASSERT_TRUE(fixture.give(CommandAction::Switch, 0, "handwheel").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
}

TEST(Handwheel, IsRefusedWhereItDrivesNothing) {
  LatheFixture lathe;
  lathe.push("O1", "O1\nG20 G98 F20\nG1 Z-4\nM30\n");
  ASSERT_TRUE(lathe.start("O1").accepted);
  EXPECT_FALSE(lathe.give(CommandAction::Handwheel, 10).accepted) << "not in handwheel mode";
  GatewayFixture toy;
  dds::Command command = toy.command(CommandAction::Switch);
  command.argument = "handwheel";
  command.value = 1;
  EXPECT_EQ(toy.send(command).reason, "a handwheel drives no program of control toy");
}

/// CEN-137: the lamp is lit in the hole, the machine stops after the retraction.
TEST(Hold, WaitsForATapToBeOutOfItsHole) {
  LatheFixture fixture;
  fixture.push("O1", "O1\nG20 G97 G99 S600 M3\nG0 Z1\nG84 F.1 R.5 Z-.5 G38\nG1 F.1 Z0\nM30\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.z() < -0.2; }));
  ASSERT_TRUE(fixture.give(CommandAction::Hold, 0).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->execution == Execution::FeedHold; }));
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.z() > 0.99 && fixture.status->feed_mm_per_min == 0; }));
  EXPECT_NEAR(fixture.z(), 1, 0.001) << "back at the level where the cycle began";
}

/// CEN-058
TEST(Hold, HasNoEffectInTappingModeUntilItEnds) {
  LatheFixture fixture;
  fixture.push("O1", "O1\nG20 G98 F60\nG63\nG1 Z-1\nX1\nG64\nZ-2\nM30\n");
  ASSERT_TRUE(fixture.give(CommandAction::FeedOverride, 0.1).accepted);
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.z() < -0.3; }));
  EXPECT_NEAR(fixture.status->feed_mm_per_min, 60 * kInch, 1e-3) << "not a tenth of it";
  ASSERT_TRUE(fixture.give(CommandAction::Hold, 0).accepted);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.x() > 0.499 && fixture.status->feed_mm_per_min == 0; }));
  EXPECT_NEAR(fixture.x(), 0.5, 1e-6);
  EXPECT_NEAR(fixture.z(), -1, 0.01);
}

/// CEN-225: halted while it faces at Z -1. Z leaves to the clearance .1 from the tool's position,
/// X goes over to where the block begins, the operator looks, Z feeds back, the block is made.
TEST(Resume, BeginsWhereTheToolStands) {
  LatheFixture fixture("start = { X = 4.0, Z = 2.0 }\n");
  fixture.push("O1", "O1\nG20 G98 F60\nP140=.1\nN10 G0 X2 Z.1\nN20 G1 Z-1\nN30 X6\nM30\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.z() < -0.999 && fixture.x() > 1.5; }));
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Aborted);
  (void)fixture.run_until([&] { return fixture.status->execution == Execution::Stopped; });
  const double halted_x = fixture.x();
  ASSERT_GT(halted_x, 1.5);
  ASSERT_LT(halted_x, 2.9);

  dds::Command again = fixture.start_command("O1");
  again.argument = "N30";
  ASSERT_TRUE(fixture.send(again).accepted);
  double farthest_x = 0;
  ASSERT_TRUE(fixture.run_until([&] {
    farthest_x = std::max(farthest_x, fixture.x());
    return fixture.status->execution == Execution::ProgramStopped;
  }));
  EXPECT_NEAR(farthest_x, halted_x, 1e-6) << "not from the setup's start at X radius 4";
  EXPECT_NEAR(fixture.x(), 1, 1e-9);
  EXPECT_NEAR(fixture.z(), 0.1, 1e-9);
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.z() < -0.999; }));
  EXPECT_LT(fixture.x(), 1.2) << "Z first";
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status->execution == Execution::ProgramCompleted; }));
  EXPECT_NEAR(fixture.x(), 3, 1e-9);
}

/// A start at the first block begins at the setup's position, as after homing.
TEST(Resume, IsOnlyForAStartInTheMiddle) {
  LatheFixture fixture("start = { X = 4.0, Z = 2.0 }\n", "max");
  fixture.push("O1", "O1\nG20\nG0 X2\nM30\n");
  for (int run = 0; run < 2; ++run) {
    ASSERT_TRUE(fixture.start("O1").accepted);
    EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
    EXPECT_NEAR(fixture.z(), 2, 1e-9);
  }
}

TEST(StartInTheMiddle, IsRefusedWithTheReasonWhereTheControlHasNone) {
  for (const interpreter::Dialect* control :
       {&interpreter::kFanucDialect, &interpreter::kRs274NgcDialect}) {
    GatewayFixture fixture(*control, {}, "max");
    fixture.push("P", "G21\nN30 G0 X1\nM2\n");
    dds::Command start = fixture.start_command("P");
    start.argument = "N30";
    const auto reply = fixture.send(start);
    EXPECT_FALSE(reply.accepted);
    EXPECT_EQ(
        reply.reason,
        fmt::format("control {} begins no program in its middle (at N30): its state is known "
                    "at the first block only. A run that was cut off is continued by a restart",
                    control->name));
  }
}

}  // namespace
}  // namespace dripline::gateway
