#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

/// The machine's status besides position and speed: CEN-228.
namespace dripline::machine::test {
namespace {

TEST(MachineStatus, NamesTheMoveThatIsMade) {
  TestMachine test;
  auto& program = test.program;
  program.spindle(500);
  program.rapid(10, 0);
  program.line(10, -10, 600);
  program.arc(0, -10, -10, 5, 180, 600);  // from X10 to X0 about X5: half a turn
  program.arc(10, -10, -10, 5, 180, 600, interpreter::Turn::Clockwise);
  program.thread(10, -20, 1);
  test.machine.poll_all(1);
  EXPECT_EQ(test.machine.status().motion, MotionKind::None);
  for (const MotionKind expected :
       {MotionKind::Rapid, MotionKind::Line, MotionKind::Counterclockwise, MotionKind::Clockwise,
        MotionKind::Thread}) {
    test.machine.poll_all(1);
    EXPECT_EQ(test.machine.status().motion, expected);
  }
}

TEST(MachineStatus, SaysThatAnAxisLimitsTheFeed) {
  TestMachine test;
  test.program.line(0, -100, 6000);  // the axes allow 3000
  test.machine.poll(Seconds{0.5});
  EXPECT_TRUE(test.machine.status().is_feed_limited);
  OperatorPanel half = test.machine.panel();
  half.feed_override = 0.4;
  test.machine.set_panel(half);
  EXPECT_FALSE(test.machine.status().is_feed_limited);
  test.run_all();
  EXPECT_FALSE(test.machine.status().is_feed_limited);
}

/// HD-082: distance to go is the difference.
TEST(MachineStatus, KnowsWhereTheMoveEnds) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.program.line(0, 50, 1200);
  const auto target = [&test] { return test.machine.status().target.linear(Axis::Z).mm(); };
  EXPECT_EQ(target(), 0) << "nothing has begun";
  test.machine.poll(Seconds{1});
  EXPECT_NEAR(test.z(), 19.8, 1e-9);
  EXPECT_EQ(target(), 100);
  test.machine.hold();
  test.run_all();
  EXPECT_EQ(target(), 100) << "held";
  test.machine.resume();
  test.machine.poll(Seconds{5});
  EXPECT_EQ(target(), 50);
  test.run_all();
  EXPECT_EQ(target(), test.z());
}

TEST(MachineStatus, CountsADwellDown) {
  TestMachine test;
  test.program.dwell(2);
  test.machine.poll(Seconds{0.5});
  EXPECT_DOUBLE_EQ(test.machine.status().dwell_left.count(), 1.5);
  test.run_all();
  EXPECT_EQ(test.machine.status().dwell_left.count(), 0);
}

TEST(MachineStatus, KnowsToolsAndCoolantWhenTheyAreExecuted) {
  TestMachine test;
  auto& events = test.machine.events();
  const auto& origin = test.program.begin_block();
  events.on_tool({origin, 4, true, 14, {}});
  events.on_coolant({origin, true, false});
  test.program.end_block();
  test.program.line(0, -10, 600);
  events.on_tool({test.program.begin_block(), 4, false, std::nullopt, {}});
  test.program.end_block();
  EXPECT_FALSE(test.machine.status().next_tool);
  test.machine.poll(Seconds{0.1});
  MachineStatus status = test.machine.status();
  EXPECT_EQ(status.next_tool, 4);
  EXPECT_EQ(status.tool_offset, 14);
  EXPECT_FALSE(status.tool);
  EXPECT_TRUE(status.flood);
  test.run_all();
  status = test.machine.status();
  EXPECT_EQ(status.tool, 4);
  EXPECT_FALSE(status.next_tool);
  test.machine.begin({});
  EXPECT_FALSE(test.machine.status().tool);
}

TEST(MachineStatus, TellsTheProgrammedSpeed) {
  TestMachine test;
  test.program.surface_speed(100'000, 2000);
  test.run_all();
  ASSERT_TRUE(test.machine.status().spindle.surface_speed);
  EXPECT_EQ(test.machine.status().spindle.surface_speed->mm(), 100'000);
}

}  // namespace
}  // namespace dripline::machine::test
