#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

class SimulatedJog : public testing::Test {
 protected:
  Jog of_z(double distance, double feed = 600) {
    return {.axis = Axis::Z, .distance = distance, .feed_per_minute = feed};
  }
  double z() const { return test.machine.status().position.raw(Axis::Z); }
  double pass(double seconds = kForever) {
    return test.machine.poll(Seconds{seconds}, MotionBackend::kNoLimit).count();
  }
  TestMachine test;
};

TEST_F(SimulatedJog, MovesOneAxisByTheDistanceAtTheFeedAndReportsNoBlock) {
  ASSERT_TRUE(test.machine.jog(of_z(-3)));
  EXPECT_TRUE(test.machine.is_jogging());
  EXPECT_NEAR(pass(), trapezoid(3, 10, 1000), 1e-9);
  EXPECT_FALSE(test.machine.is_jogging());
  EXPECT_EQ(z(), -3);
  EXPECT_EQ(test.machine.status().position.raw(Axis::X), 0);
  EXPECT_TRUE(test.recorder.lines.empty());
  EXPECT_EQ(test.machine.state(), MachineState::Idle);
}

TEST_F(SimulatedJog, IsRefusedWhileOneMovesAndWithinAProgram) {
  ASSERT_TRUE(test.machine.jog(of_z(10)));
  pass(0.1);
  const auto second = test.machine.jog(of_z(-10));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  pass();
  EXPECT_EQ(z(), 10);
  test.program.line(0, 100, 1200);
  EXPECT_FALSE(test.machine.jog(of_z(1)));
  pass(0.5);
  EXPECT_FALSE(test.machine.jog(of_z(1)));
  test.machine.hold();
  pass();
  EXPECT_FALSE(test.machine.jog(of_z(1))) << "a held program continues where it was";
}

TEST_F(SimulatedJog, EachStopBrakesItWhereItIs) {
  const std::vector<std::function<void(SimulatedMachine&)>> stops{
      [](SimulatedMachine& machine) { machine.stop_jog(); },
      [](SimulatedMachine& machine) { machine.hold(); },
      [](SimulatedMachine& machine) { machine.abort(); },
      [](SimulatedMachine& machine) { machine.set_panel({.feed_override = 0}); },
      [](SimulatedMachine& machine) { machine.set_panel({.emergency_stop = true}); }};
  for (std::size_t i = 0; i < stops.size(); ++i) {
    TestMachine other;
    ASSERT_TRUE(other.machine.jog(of_z(50)));
    (void)other.machine.poll(Seconds{0.5}, MotionBackend::kNoLimit);
    const double before = other.machine.status().position.raw(Axis::Z);
    EXPECT_GT(before, 4);
    stops[i](other.machine);
    EXPECT_TRUE(other.machine.is_jogging()) << "it brakes";
    (void)other.machine.poll(Seconds{kForever}, MotionBackend::kNoLimit);
    EXPECT_FALSE(other.machine.is_jogging());
    const double rested = other.machine.status().position.raw(Axis::Z);
    EXPECT_NEAR(rested - before, 10.0 * 10 / 2 / 1000, 1e-6) << i;
    (void)other.machine.poll(Seconds{kForever}, MotionBackend::kNoLimit);
    EXPECT_EQ(other.machine.status().position.raw(Axis::Z), rested) << "and does not continue";
    if (i < 3) {
      ASSERT_TRUE(other.machine.jog(of_z(1))) << i;
    } else {
      EXPECT_FALSE(other.machine.jog(of_z(1))) << i;
    }
  }
}

TEST_F(SimulatedJog, NoOverrideAndNoDryRunChangesItsFeed) {
  test.machine.set_panel({.feed_override = 2, .dry_run = true, .dry_run_speed = 90});
  ASSERT_TRUE(test.machine.jog(of_z(30)));
  pass(1);
  EXPECT_NEAR(z(), 10 * (1 - 0.005), 1e-6);
  test.machine.set_panel({.feed_override = 0.1, .handwheel = true});
  EXPECT_NEAR(pass(), trapezoid(30, 10, 1000) - 1, 1e-6);
  EXPECT_EQ(z(), 30);
}

TEST_F(SimulatedJog, EndsWithinTheTravelAndMayReturnIntoIt) {
  MachineLimits limits = plain_lathe();
  limits.axis(Axis::Z)->min = -5;
  limits.axis(Axis::Z)->max = 5;
  TestMachine other(limits);
  const auto beyond = other.machine.jog(of_z(5.01));
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().what, "axis Z would go to 5.01 mm, its travel ends at 5");
  EXPECT_FALSE(other.machine.is_jogging());
  EXPECT_TRUE(other.machine.jog(of_z(5)));
  (void)other.machine.poll(Seconds{kForever}, MotionBackend::kNoLimit);
  other.machine.begin(Program::at(0, 8));
  EXPECT_FALSE(other.machine.jog(of_z(1)));
  EXPECT_TRUE(other.machine.jog(of_z(-4)));
}

TEST_F(SimulatedJog, RefusesAnAxisAndValuesThatCannotBe) {
  EXPECT_FALSE(test.machine.jog({.axis = Axis::Y, .distance = 1, .feed_per_minute = 100}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, kForever, -kForever, 0.0})
    EXPECT_FALSE(test.machine.jog(of_z(bad))) << bad;
  for (const double bad : {nan, 0.0, -5.0}) EXPECT_FALSE(test.machine.jog(of_z(1, bad))) << bad;
  EXPECT_FALSE(test.machine.is_jogging());
  EXPECT_EQ(z(), 0);
}

/// The next program begins where the axes are asked to be, as without a jog.
TEST_F(SimulatedJog, LeavesNothingOfItselfToTheNextProgram) {
  test.program.line(0, 20, 1200);
  test.program.end();
  test.run_all();
  ASSERT_EQ(test.machine.state(), MachineState::Completed);
  ASSERT_TRUE(test.machine.jog(of_z(5)));
  pass();
  EXPECT_EQ(z(), 25);
  EXPECT_EQ(test.machine.state(), MachineState::Completed);
  test.recorder.lines.clear();
  test.machine.begin_next(test.machine.status().position);
  test.program.line(0, 26, 600);
  EXPECT_NEAR(test.run_all(), trapezoid(1, 10, 1000), 1e-9);
  EXPECT_EQ(z(), 26);
}

}  // namespace
}  // namespace dripline::machine::test
