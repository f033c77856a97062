#include <gtest/gtest.h>

#include "gateway/interpreter/core/event.hpp"
#include "tests/unit/gateway/machine/test_machine.hpp"

/// What a program keeps the operator's hands off: G63, tapping cycles, threads.
/// Rows: CEN-058, CEN-137, HD-169.
namespace dripline::machine::test {
namespace {

using interpreter::FeedHoldInhibit;
using interpreter::OverrideInhibit;

OverrideInhibit tapping() {
  return interpreter::tapping_lock({});
}
OverrideInhibit after_tap() {
  return interpreter::lock_after_tap({});
}

/// To the hole's bottom at Z -20 and back to 0 (1 s each at 20 mm/s), out to 50, then on to X 40.
void tap_a_hole(TestMachine& test) {
  test.program.lock(tapping());
  test.program.line(0, -20, 1200);
  test.program.spindle(500);
  test.program.line(0, 0, 1200);
  test.program.lock(after_tap());
  test.program.rapid(0, 50);
  test.program.unlock();
  test.program.line(40, 50, 1200);
}

TEST(OverrideInhibit, KeepsTheFeedAtItsFullValue) {
  TestMachine test;
  OperatorPanel panel;
  panel.feed_override = 0.5;
  test.machine.set_panel(panel);
  test.program.lock(tapping());
  test.program.line(0, 100, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(100, 20, 1000), 1e-9);
  test.program.unlock();
  test.program.line(0, 0, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(100, 10, 1000), 1e-9);
}

TEST(OverrideInhibit, KeepsTheSpindleAtItsFullSpeed) {
  TestMachine test;
  OperatorPanel panel;
  panel.spindle_override = 0.6;
  test.machine.set_panel(panel);
  test.program.spindle(600);
  test.program.lock(tapping());
  test.program.line(0, 20, Feed::per_revolution(Length::mm(2)));  // 20 mm/s at 600
  test.machine.poll(Seconds{0.5});
  EXPECT_EQ(test.machine.status().spindle_rpm, 600);
  test.run_all();
  test.program.unlock();
  test.program.line(0, 0, Feed::per_revolution(Length::mm(2)));
  EXPECT_NEAR(test.run_all(), trapezoid(20, 12, 1000), 1e-9);
  EXPECT_EQ(test.machine.status().spindle_rpm, 360);
}

TEST(OverrideInhibit, DelaysAHoldAskedForInTheHoleAfterTheWayOut) {
  TestMachine test;
  tap_a_hole(test);
  test.machine.poll(Seconds{0.5});
  test.machine.hold();
  EXPECT_EQ(test.machine.state(), MachineState::Held) << "the lamp is lit";
  test.run_all();
  EXPECT_FALSE(test.machine.is_moving());
  EXPECT_NEAR(test.z(), 50, 1e-9);
  EXPECT_NEAR(test.x(), 0, 0.2) << "no further than it takes to come to rest";
  EXPECT_TRUE(test.machine.resume());
  test.run_all();
  EXPECT_EQ(test.x(), 40);
}

TEST(OverrideInhibit, LetsAHoldActAtOnceOnTheWayOut) {
  TestMachine test;
  tap_a_hole(test);
  test.machine.poll(Seconds{2.3});  // the retraction takes half a second
  ASSERT_GT(test.z(), 0);
  test.machine.hold();
  test.run_all();
  EXPECT_LT(test.z(), 50);
  EXPECT_FALSE(test.machine.is_moving());
}

TEST(OverrideInhibit, IsNotBegunWhileHeld) {
  TestMachine test;
  test.machine.hold();
  tap_a_hole(test);
  test.run_all();
  EXPECT_EQ(test.z(), 0);
}

/// No machine stops in the turn from rapid to tap when it is too fast for that.
TEST(OverrideInhibit, IsGoneThroughWhenThereIsNoRoomToStopBefore) {
  TestMachine test;
  test.program.rapid(0, 20, false);
  test.program.lock(tapping());
  test.program.line(0, 40, 1200);
  test.program.line(0, 20, 1200);
  test.program.unlock();
  test.program.line(0, 0, 1200);
  const double rapid =
      20.0 / 100 + 0.1 / 2 + 0.08 * 0.08 / 2 / 0.1;  // brakes to 20 mm/s at its end
  test.machine.poll(Seconds{rapid - 0.005});
  test.machine.hold();
  test.run_all();
  EXPECT_NEAR(test.z(), 20, 0.2);
  EXPECT_EQ(test.recorder.blocks.back(), 3u) << "back out of the hole";
}

TEST(OverrideInhibit, IsFinishedWithoutABudgetOfActions) {
  TestMachine test;
  tap_a_hole(test);
  test.machine.poll(Seconds{0.5});
  test.machine.hold();
  test.machine.poll(Seconds{60}, 0);
  EXPECT_NEAR(test.z(), 50, 1e-9);
}

TEST(OverrideInhibit, DoesNotStopAnAbort) {
  TestMachine test;
  tap_a_hole(test);
  test.machine.poll(Seconds{0.5});
  test.machine.abort();
  test.run_all();
  EXPECT_EQ(test.machine.state(), MachineState::Aborted);
  EXPECT_NEAR(test.z(), -10, 0.1) << "0.2 mm short of 10 at the ramp up, 0.2 on at the ramp down";
}

TEST(OverrideInhibit, KeepsSingleBlockOffUntilItIsTakenBack) {
  TestMachine test;
  OperatorPanel panel;
  panel.single_block = true;
  test.machine.set_panel(panel);
  OverrideInhibit lock;
  lock.single_block = true;
  test.program.lock(lock);
  test.program.line(0, 10, 1200);
  test.program.line(0, 20, 1200);
  test.program.unlock();
  test.program.line(0, 30, 1200);
  test.program.line(0, 40, 1200);
  test.run_all();
  EXPECT_EQ(test.machine.state(), MachineState::SingleBlock);
  EXPECT_EQ(test.z(), 30);
}

/// The lock is taken back within the block whose last move is under it.
TEST(OverrideInhibit, TakenBackBeforeTheBlocksEndStopsAfterTheBlock) {
  TestMachine test;
  OperatorPanel panel;
  panel.single_block = true;
  test.machine.set_panel(panel);
  const Origin origin = test.program.begin_block();
  test.machine.events().on_override_inhibit(tapping());
  test.machine.events().on_line({origin, Program::at(0, 10), Feed::per_minute(Length::mm(1200))});
  test.program.unlock();
  test.program.end_block();
  test.program.line(0, 20, 1200);
  test.run_all();
  EXPECT_EQ(test.machine.state(), MachineState::SingleBlock);
  EXPECT_EQ(test.z(), 10);
}

TEST(OverrideInhibit, HoldsOffBetweenThreadsThatFollowOneAnother) {
  TestMachine test;
  test.program.spindle(600);
  test.program.thread(0, 20, 2);
  test.program.thread(5, 25, 2);  // the pull-out
  test.program.rapid(5, 50);
  test.machine.poll(Seconds{0.5});
  test.machine.hold();
  test.run_all();
  EXPECT_NEAR(test.x(), 5, 1e-9);
  EXPECT_LT(test.z(), 26);
}

TEST(OverrideInhibit, EndsWithItsProgram) {
  TestMachine test;
  test.program.lock(tapping());
  test.machine.begin(Program::at(0, 0));
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});
  test.machine.hold();
  test.run_all();
  EXPECT_LT(test.z(), 21);
}

}  // namespace
}  // namespace dripline::machine::test
