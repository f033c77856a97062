#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

constexpr double kExact = 1e-9;

struct LineCase {
  const char* name;
  double x, z, feed;  ///< mm/min
  double seconds;
};
class StraightMove : public testing::TestWithParam<LineCase> {};

TEST_P(StraightMove, TakesTheTimeOfItsTrapezoid) {
  TestMachine test;
  test.program.line(GetParam().x, GetParam().z, GetParam().feed);
  EXPECT_NEAR(test.run_all(), GetParam().seconds, kExact);
  EXPECT_EQ(test.x(), GetParam().x);
  EXPECT_EQ(test.z(), GetParam().z);
}

INSTANTIATE_TEST_SUITE_P(
    , StraightMove,
    testing::Values(LineCase{"long_reaches_its_feed", 0, 100, 1200, 100.0 / 20 + 20.0 / 1000},
                    LineCase{"short_is_a_triangle", 0, 0.1, 1200, 2 * std::sqrt(0.1 / 1000)},
                    LineCase{"backwards_is_the_same", 0, -100, 1200, 100.0 / 20 + 0.02},
                    LineCase{"feed_is_cut_at_the_axis_limit", 0, 100, 9000, 100.0 / 50 + 0.05},
                    // Both axes share the work: 1000 * sqrt(2) along the diagonal.
                    LineCase{"diagonal_accelerates_faster", 30, 30, 600,
                             30 * std::sqrt(2) / 10 + 10 / (1000 * std::sqrt(2))}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(Rapid, MovesStraightAtTheSlowestAxisShare) {
  TestMachine test;
  test.program.rapid(30, 40);  // Z does 100 mm/s, the path 125, with 1250 mm/s^2
  EXPECT_NEAR(test.run_all(), trapezoid(50, 125, 1250), kExact);
}

TEST(ArcMove, TakesTheTimeOfItsLength) {
  TestMachine test;
  test.program.line(0, 10, 600);
  const double to_start = test.run_all();
  test.program.arc(10, 0, 0, 0, 90, 600);
  EXPECT_NEAR(test.run_all(), trapezoid(10 * Angle::kPi / 2, 10, 1000), kExact);
  EXPECT_NEAR(to_start, trapezoid(10, 10, 1000), kExact);
}

TEST(ArcMove, StaysOnItsCircle) {
  TestMachine test;
  test.program.line(0, 10, 600);
  test.run_all();
  test.program.arc(10, 0, 0, 0, 90, 600);
  for (int i = 0; i < 12; ++i) {
    test.machine.poll(Seconds{0.1});
    EXPECT_NEAR(std::hypot(test.x(), test.z()), 10, 1e-9);
    EXPECT_GT(test.x(), 0);
    EXPECT_GT(test.z(), 0);
  }
}

TEST(ArcMove, IsAsSlowAsItsRadiusDemands) {
  TestMachine test;
  test.program.line(0, 0.1, 600);
  test.run_all();
  test.program.arc(0, 0.1, 0, 0, 360, 3000);  // 50 mm/s wanted; sqrt(1000 * 0.1) = 10 allowed
  EXPECT_NEAR(test.run_all(), trapezoid(0.2 * Angle::kPi, 10, 1000), kExact);
}

TEST(ArcMove, TakesTheTurnThatMeetsTheEndWhateverItIsCalled) {
  TestMachine test;
  test.program.line(0, 10, 600);
  test.run_all();
  test.program.arc(10, 0, 0, 0, 90, 600, interpreter::Turn::Clockwise);
  test.machine.poll(Seconds{0.5});
  EXPECT_NEAR(std::hypot(test.x(), test.z()), 10, 1e-9);
  EXPECT_GT(test.z(), 0);
  EXPECT_GT(test.x(), 0);
}

TEST(DwellMove, LastsItsSeconds) {
  TestMachine test;
  test.program.dwell(2.5);
  EXPECT_EQ(test.machine.poll(Seconds{1}).count(), 1);
  EXPECT_EQ(test.machine.state(), MachineState::Running);
  EXPECT_NEAR(test.run_all(), 1.5, kExact);
}

TEST(DwellMove, CountsTurnsOfTheSpindle) {
  TestMachine test;
  test.program.spindle(600);
  test.program.begin_block();
  test.machine.events().on_dwell({{}, 0, 20.0});
  EXPECT_NEAR(test.run_all(), 2, kExact);
}

TEST(FeedPerRevolution, FollowsTheSpindle) {
  TestMachine test;
  test.program.spindle(600);  // 10 revolutions a second
  test.program.line(0, 10, Feed::per_revolution(Length::mm(0.5)));
  EXPECT_NEAR(test.run_all(), trapezoid(10, 5, 1000), kExact);
}

TEST(DryRunFeed, IsThatOfAllAxesTogether) {
  MachineLimits limits = plain_lathe();
  limits.axis(Axis::C) = limits.axis(Axis::X);
  TestMachine test(limits);
  OperatorPanel panel;
  panel.dry_run = true;
  panel.dry_run_speed = 10;
  test.machine.set_panel(panel);
  Position to = Program::at(30, 0);
  to.set(Axis::C, Angle::degrees(40));
  const Origin& origin = test.program.begin_block();
  test.machine.events().on_line({origin, to, Feed::per_minute(Length::mm(3000))});
  test.program.end_block();
  EXPECT_NEAR(test.run_all(), 50.0 / 10, 0.05);
}

TEST(FeedPerRevolution, FollowsTheSpindleOverride) {
  TestMachine test;
  test.program.spindle(600);
  test.program.line(0, 10, Feed::per_revolution(Length::mm(0.5)));
  OperatorPanel panel;
  panel.spindle_override = 1.2;
  test.machine.set_panel(panel);
  EXPECT_NEAR(test.run_all(), trapezoid(10, 6, 1000), kExact);
}

TEST(FeedPerRevolution, WithASpindleAtRestIsAnAlarmBeforeMoving) {
  TestMachine test;
  test.program.line(0, 10, Feed::per_revolution(Length::mm(0.5)));
  EXPECT_EQ(test.run_all(), 0);
  ASSERT_EQ(test.recorder.lines.size(), 1u);
  EXPECT_TRUE(test.recorder.lines[0].starts_with("alarm MCH0004"));
}

TEST(SurfaceSpeed, TurnsFasterTowardsTheCenterUpToItsLimit) {
  TestMachine test;
  test.machine.begin(Program::at(50, 0));
  test.program.surface_speed(100'000, 1000);
  test.run_all();
  EXPECT_NEAR(test.machine.status().spindle_rpm, 100'000 / (100 * Angle::kPi), 1e-9);
  test.program.line(5, 0, Feed::per_revolution(Length::mm(0.2)));
  // Revolutions of the move, by integrating 1 / rpm: below r = 100000 / (2000 pi) at 1000 rpm.
  const double bend = 100'000 / (2'000 * Angle::kPi);
  const double minutes = ((bend - 5) / 1000 + Angle::kPi / 100'000 * (2500 - bend * bend)) / 0.2;
  const double even_speed = 45 / (minutes * 60);
  EXPECT_NEAR(test.run_all(), minutes * 60 + even_speed / 1000, 1e-9);
  EXPECT_NEAR(test.machine.status().spindle_rpm, 1000, 1e-9);
}

// CEN-092: the spindle speed of a rapid is that of its end, not of its position
TEST(SurfaceSpeed, OfARapidIsThatOfItsEnd) {
  TestMachine test;
  test.machine.begin(Program::at(50, 0));
  test.program.surface_speed(100'000, 5000);
  test.program.rapid(20, 0);
  test.machine.poll(Seconds{0.001});
  EXPECT_NEAR(test.machine.status().spindle_rpm, 100'000 / (40 * Angle::kPi), 1e-9);
}

TEST(InverseTime, TakesItsShareOfAMinute) {
  TestMachine test;
  test.program.line(0, 10, Feed::inverse_time(30));  // 2 s: 5 mm/s
  EXPECT_NEAR(test.run_all(), trapezoid(10, 5, 1000), kExact);
}

TEST(ThreadMove, IgnoresTheFeedOverride) {
  TestMachine test;
  OperatorPanel panel;
  panel.feed_override = 0.25;
  test.machine.set_panel(panel);
  test.program.spindle(600);
  test.program.thread(0, -20, 1.5);
  EXPECT_NEAR(test.run_all(), trapezoid(20, 15, 1000), kExact);
}

TEST(ThreadMove, ThatTheAxesCannotFollowIsAnAlarm) {
  TestMachine test;
  test.program.spindle(3000);
  test.program.thread(0, -20, 6);
  test.run_all();
  EXPECT_TRUE(test.recorder.lines.back().starts_with("alarm MCH0007"));
}

TEST(SurfaceSpeed, LimitedToZeroIsASpindleAtRest) {
  TestMachine test;
  test.machine.begin(Program::at(50, 0));
  test.program.surface_speed(100'000, 0);
  test.program.line(5, 0, Feed::per_revolution(Length::mm(0.2)));
  test.run_all();
  EXPECT_TRUE(test.recorder.lines.back().starts_with("alarm MCH0004"));
}

TEST(ShortestMove, TooShortToSquareIsNoMove) {
  TestMachine test;
  test.program.line(0, 1e-200, 1200);
  EXPECT_EQ(test.run_all(), 0);
  EXPECT_EQ(test.recorder.lines, std::vector<std::string>{"block 1"});
}

TEST(ZeroFeed, IsAnAlarm) {
  TestMachine test;
  test.program.line(0, 10, 0);
  test.run_all();
  EXPECT_TRUE(test.recorder.lines.back().starts_with("alarm MCH0003"));
}

}  // namespace
}  // namespace dripline::machine::test
