#include <gtest/gtest.h>
#include <functional>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "tests/unit/gateway/machine/test_machine.hpp"

/// A program driven by the handwheel. Row: CEN-224.
namespace dripline::machine::test {
namespace {

OperatorPanel by_handwheel() {
  OperatorPanel panel;
  panel.handwheel = true;
  return panel;
}

/// One block: down to Z -20 and back to 10.
void tap(TestMachine& test) {
  const Origin origin = test.program.begin_block();
  interpreter::EventSink& events = test.machine.events();
  const Feed feed = Feed::per_minute(Length::mm(1200));
  events.on_override_inhibit(interpreter::tapping_lock(origin));
  events.on_line({origin, Program::at(0, -20), feed});
  events.on_spindle({origin, interpreter::SpindleState::Counterclockwise, 500, {}, {}});
  events.on_line({origin, Program::at(0, 10), feed});
  test.program.unlock();
  test.program.end_block();
}

TEST(Handwheel, LetsTheProgramsTimePassOnlyAsItIsTurned) {
  TestMachine test;
  test.machine.set_panel(by_handwheel());
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{5});
  EXPECT_EQ(test.z(), 0);
  EXPECT_FALSE(test.machine.is_moving());
  test.machine.turn_handwheel(Seconds{0.5});
  EXPECT_EQ(test.machine.poll(Seconds{5}).count(), 0.5);
  EXPECT_NEAR(test.z(), 0.5 * 20 - 0.2, 1e-9);
  EXPECT_EQ(test.machine.status().feed_per_minute, 0) << "the wheel is at rest";
  test.machine.turn_handwheel(Seconds{100});
  test.run_all();
  EXPECT_EQ(test.z(), 100);
}

/// Turned faster than the program's own speed, the rest follows at that speed.
TEST(Handwheel, NeverDrivesFasterThanTheProgram) {
  TestMachine test;
  test.machine.set_panel(by_handwheel());
  test.program.line(0, 100, 1200);
  test.machine.turn_handwheel(Seconds{2});
  test.machine.poll(Seconds{1});
  EXPECT_NEAR(test.z(), 20 - 0.2, 1e-9);
  EXPECT_TRUE(test.machine.is_moving());
}

TEST(Handwheel, TakesThePlaceOfTheFeedSwitch) {
  TestMachine test;
  OperatorPanel panel = by_handwheel();
  panel.feed_override = 0.1;
  test.machine.set_panel(panel);
  test.program.line(0, 100, 1200);
  test.machine.turn_handwheel(Seconds{1});
  test.run_all();
  EXPECT_NEAR(test.z(), 20 - 0.2, 1e-9);
}

TEST(Handwheel, TurnedForNothingIsForgotten) {
  TestMachine test;
  test.machine.set_panel(by_handwheel());
  test.machine.turn_handwheel(Seconds{10});
  test.run_all();
  test.program.line(0, 100, 1200);
  test.run_all();
  EXPECT_EQ(test.z(), 0);
}

TEST(Handwheel, DrivesNothingInAnotherMode) {
  TestMachine test;
  test.machine.turn_handwheel(Seconds{10});
  test.machine.set_panel(by_handwheel());
  test.program.line(0, 100, 1200);
  test.run_all();
  EXPECT_EQ(test.z(), 0);
  test.machine.set_panel({});
  test.run_all();
  EXPECT_EQ(test.z(), 100) << "the program continues by itself";
}

TEST(Handwheel, AtRestStillLetsAHoldAndAnAbortEnd) {
  for (const bool aborts : {false, true}) {
    TestMachine test;
    test.program.line(0, 100, 1200);
    test.machine.poll(Seconds{1});
    test.machine.set_panel(by_handwheel());
    if (aborts) {
      test.machine.abort();
    } else {
      test.machine.hold();
    }
    test.run_all();
    EXPECT_EQ(test.machine.state(), aborts ? MachineState::Aborted : MachineState::Held);
    EXPECT_FALSE(test.machine.is_moving());
  }
}

/// Turned for half a second of a move at 20 mm/s; since then the axes rest.
void rest_in_move(TestMachine& test) {
  test.machine.set_panel(by_handwheel());
  test.program.line(0, 100, 1200);
  test.program.line(50, 100, 1200);
  test.machine.turn_handwheel(Seconds{0.5});
  test.run_all();
}

TEST(Handwheel, AxesThatRestStayAtRestInAHoldAnAbortAndAnEmergencyStop) {
  OperatorPanel pressed = by_handwheel();
  pressed.emergency_stop = true;
  const std::vector<std::function<void(SimulatedMachine&)>> stops{
      [](auto& machine) { machine.hold(); }, [](auto& machine) { machine.abort(); },
      [&](auto& machine) { machine.set_panel(pressed); }};
  for (std::size_t stop = 0; stop < stops.size(); ++stop) {
    TestMachine test;
    rest_in_move(test);
    const double z = test.z();
    stops[stop](test.machine);
    EXPECT_FALSE(test.machine.is_moving()) << stop;
    EXPECT_EQ(test.machine.status().feed_per_minute, 0) << stop;
    test.machine.turn_handwheel(Seconds{1});
    test.run_all();
    EXPECT_EQ(test.z(), z) << stop;
  }
}

/// The wheel rests exactly between two moves that are passed without a stop.
TEST(Handwheel, AHoldBetweenTwoMovesBeginsNeither) {
  TestMachine test;
  test.machine.set_panel(by_handwheel());
  test.program.line(0, 10, 1200);
  test.program.line(0, 100, 1200);
  test.machine.turn_handwheel(Seconds{10.0 / 20 + 0.01});
  test.run_all();
  ASSERT_NEAR(test.z(), 10, 1e-9);
  test.machine.hold();
  test.run_all();
  EXPECT_NEAR(test.z(), 10, 1e-9);
  EXPECT_EQ(test.machine.state(), MachineState::Held);
}

TEST(Handwheel, AMoveThatCannotBeHeldIsNotExecutedFromRest) {
  TestMachine test;
  test.machine.set_panel(by_handwheel());
  test.program.lock({.origin = {}, .hold = interpreter::FeedHoldInhibit::Later});
  test.program.line(0, 100, 1200);
  test.machine.turn_handwheel(Seconds{0.5});
  test.run_all();
  const double z = test.z();
  test.machine.hold();
  test.run_all();
  EXPECT_EQ(test.z(), z);
  EXPECT_EQ(test.machine.state(), MachineState::Held);
}

/// What was turned before the hold, or in it, moves nothing after the resume.
TEST(Handwheel, AHoldDropsWhatWasTurned) {
  TestMachine test;
  test.machine.set_panel(by_handwheel());
  test.program.line(0, 100, 1200);
  test.machine.turn_handwheel(Seconds{4});
  test.machine.poll(Seconds{1});
  test.machine.hold();
  test.machine.turn_handwheel(Seconds{1});
  test.run_all();
  const double z = test.z();
  EXPECT_NEAR(z, 20, 1e-9) << "it brakes from the speed of the wheel";
  ASSERT_TRUE(test.machine.resume());
  test.run_all();
  EXPECT_EQ(test.z(), z);
  test.machine.turn_handwheel(Seconds{100});
  test.run_all();
  EXPECT_EQ(test.z(), 100);
}

TEST(Handwheel, TheProgramContinuesByItselfFromRest) {
  TestMachine test;
  rest_in_move(test);
  const double z = test.z();
  test.machine.set_panel({});
  test.machine.poll(Seconds{0.1});
  EXPECT_LT(test.z(), z + 20 * 0.1 - 0.1) << "it accelerates";
}

TEST(Handwheel, LeavesATappingCycleOutAndSaysSo) {
  TestMachine test;
  test.recorder.writes_blocks = false;
  test.machine.set_panel(by_handwheel());
  test.program.rapid(0, 10);
  tap(test);
  test.program.line(30, 10, 1200);
  test.machine.turn_handwheel(Seconds{60});
  const double used = test.run_all();
  EXPECT_NEAR(used, trapezoid(10, 100, 1000) + trapezoid(30, 20, 1000), 1e-9);
  EXPECT_EQ(test.x(), 30);
  EXPECT_EQ(test.z(), 10);
  ASSERT_EQ(test.recorder.lines.size(), 1U);
  EXPECT_TRUE(
      test.recorder.lines[0].starts_with("message tapping cycles are not done in handwheel mode"));
}

TEST(SpindleOverride, OfZeroStopsADwellOfTurnsUntilItIsRaised) {
  TestMachine test;
  test.program.spindle(600);
  test.program.revolve(5);  // half a second
  OperatorPanel panel;
  panel.spindle_override = 0;
  test.machine.set_panel(panel);
  EXPECT_EQ(test.run_all(), 0);
  panel.spindle_override = 2;
  test.machine.set_panel(panel);
  EXPECT_NEAR(test.run_all(), 0.25, 1e-9);
}

}  // namespace
}  // namespace dripline::machine::test
