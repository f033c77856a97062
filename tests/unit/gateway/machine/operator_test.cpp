#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

OperatorPanel with_feed(double override) {
  OperatorPanel panel;
  panel.feed_override = override;
  return panel;
}

TEST(Panel, IsClampedToWhatAHandCanSet) {
  OperatorPanel panel;
  panel.feed_override = 9;
  panel.rapid_override = -1;
  panel.spindle_override = 0;
  TestMachine test;
  test.machine.set_panel(panel);
  EXPECT_EQ(test.machine.panel().feed_override, 2);
  EXPECT_EQ(test.machine.panel().rapid_override, 0);
  EXPECT_EQ(test.machine.panel().spindle_override, 0);
}

TEST(Override, ScalesTheFeed) {
  for (const double factor : {0.5, 1.0, 1.5, 2.0}) {
    TestMachine test;
    test.machine.set_panel(with_feed(factor));
    test.program.line(0, 100, 1200);
    EXPECT_NEAR(test.run_all(), trapezoid(100, 20 * factor, 1000), 1e-9) << factor;
  }
}

/// Row: TK-30.
TEST(Override, NeverGoesBeyondTheControlsFastestFeed) {
  MachineLimits limits = plain_lathe();
  limits.fastest_feed_per_minute = 1500;
  for (const double factor : {1.0, 1.25, 2.0}) {
    TestMachine test(limits);
    test.machine.set_panel(with_feed(factor));
    test.program.line(0, 100, 1200);
    EXPECT_NEAR(test.run_all(), trapezoid(100, std::min(20 * factor, 25.0), 1000), 1e-9) << factor;
  }
}

TEST(Override, OfRapidsLeavesFeedsAlone) {
  OperatorPanel panel;
  panel.rapid_override = 0.25;
  TestMachine test;
  test.machine.set_panel(panel);
  test.program.rapid(0, 100);
  EXPECT_NEAR(test.run_all(), trapezoid(100, 25, 1000), 1e-9);
  test.program.line(0, 0, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(100, 20, 1000), 1e-9);
}

TEST(Override, ChangedOnTheWayRampsAndLosesNoDistance) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});  // 19.8 mm done, at 20 mm/s
  test.machine.set_panel(with_feed(0.5));
  const double ramp = 10.0 / 1000;
  const double left = 100 - 19.8 - 15 * ramp - 100.0 / 2000;
  EXPECT_NEAR(test.run_all(), ramp + left / 10 + ramp, 1e-9);
  EXPECT_EQ(test.z(), 100);
}

TEST(Override, LoweredAcrossShortBlocksStillRamps) {
  TestMachine test;
  for (int i = 1; i <= 10'000 && test.machine.has_room(); ++i)
    test.program.line(0, i * 0.001, 1200);
  test.machine.poll(Seconds{0.2});
  const double before = test.machine.status().feed_per_minute;
  test.machine.set_panel(with_feed(0.1));
  test.machine.poll(Seconds{0.001});
  EXPECT_NEAR(before, 1200, 1e-6);
  EXPECT_NEAR(test.machine.status().feed_per_minute, 1200 - 60, 1e-3);
}

TEST(Override, OfZeroStandsUntilItIsRaised) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});
  test.machine.set_panel(with_feed(0));
  EXPECT_NEAR(test.run_all(), 0.02, 1e-9);
  EXPECT_EQ(test.machine.state(), MachineState::Running);
  EXPECT_FALSE(test.machine.is_moving());
  EXPECT_EQ(test.machine.poll(Seconds{1}).count(), 0);
  test.machine.set_panel(with_feed(1));
  test.run_all();
  EXPECT_EQ(test.z(), 100);
}

TEST(Hold, SlowsDownAlongThePathAndResumesWithoutLosingDistance) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});
  test.machine.hold();
  EXPECT_EQ(test.machine.state(), MachineState::Held);
  EXPECT_TRUE(test.machine.is_moving());
  EXPECT_NEAR(test.run_all(), 0.02, 1e-9);
  EXPECT_FALSE(test.machine.is_moving());
  EXPECT_NEAR(test.z(), 19.8 + 0.2, 1e-9);
  EXPECT_TRUE(test.recorder.blocks.empty());
  EXPECT_TRUE(test.machine.resume());
  EXPECT_NEAR(test.run_all(), trapezoid(80, 20, 1000), 1e-9);
  EXPECT_EQ(test.z(), 100);
}

TEST(Hold, CrossesBlocksWhileSlowingDown) {
  TestMachine test;
  for (int i = 1; i <= 1000; ++i) test.program.line(0, i * 0.05, 1200);
  test.machine.poll(Seconds{1});
  test.machine.hold();
  const auto before = test.recorder.blocks.size();
  test.run_all();
  EXPECT_NEAR(test.z(), 20, 1e-9);  // 0.2 mm further: four blocks
  EXPECT_NEAR(static_cast<double>(test.recorder.blocks.size() - before), 4, 1);
  test.machine.resume();
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), 1000u);
  EXPECT_EQ(test.z(), 50);
}

TEST(Hold, ComesToRestEvenWithoutABudgetOfActions) {
  TestMachine test;
  for (int i = 1; i <= 1000; ++i) test.program.line(0, i * 0.05, 1200);
  test.machine.poll(Seconds{1});
  test.machine.hold();
  EXPECT_NEAR(test.machine.poll(Seconds{1}, 0).count(), 0.02, 1e-9);
  EXPECT_FALSE(test.machine.is_moving());
}

TEST(Hold, OnAnArcStaysOnTheArc) {
  TestMachine test;
  test.machine.begin(Program::at(0, 10));
  test.program.arc(10, 0, 0, 0, 90, 1200);
  test.machine.poll(Seconds{0.3});
  test.machine.hold();
  test.run_all();
  EXPECT_NEAR(std::hypot(test.x(), test.z()), 10, 1e-9);
  test.machine.resume();
  test.run_all();
  EXPECT_EQ(test.x(), 10);
}

TEST(Hold, LetsAThreadFinish) {
  TestMachine test;
  test.program.spindle(600);
  test.program.thread(0, -20, 1.5);
  test.program.line(0, 0, 1200);
  test.machine.poll(Seconds{0.5});
  test.machine.hold();
  test.run_all();
  EXPECT_EQ(test.z(), -20);
  EXPECT_EQ(test.machine.state(), MachineState::Held);
  EXPECT_EQ(test.recorder.blocks.size(), 2u);
}

TEST(Hold, PausesADwell) {
  TestMachine test;
  test.program.dwell(2);
  test.machine.poll(Seconds{0.5});
  test.machine.hold();
  EXPECT_EQ(test.run_all(), 0);
  test.machine.resume();
  EXPECT_NEAR(test.run_all(), 1.5, 1e-9);
}

TEST(Hold, BeforeTheFirstMoveStartsNothing) {
  TestMachine test;
  test.machine.hold();
  test.program.output("not yet");
  EXPECT_EQ(test.run_all(), 0);
  EXPECT_TRUE(test.recorder.lines.empty());
  EXPECT_TRUE(test.machine.resume());
  test.run_all();
  EXPECT_EQ(test.recorder.lines.front(), "output not yet");
}

TEST(SingleBlock, StandsAfterEachBlock) {
  OperatorPanel panel;
  panel.single_block = true;
  TestMachine test;
  test.machine.set_panel(panel);
  for (int i = 1; i <= 3; ++i) test.program.line(0, i * 10, 1200);
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_NEAR(test.run_all(), trapezoid(10, 20, 1000), 1e-9);
    EXPECT_EQ(test.recorder.blocks.size(), i);
    EXPECT_EQ(test.machine.state(), MachineState::SingleBlock);
    EXPECT_TRUE(test.machine.resume());
  }
}

TEST(SingleBlock, SwitchedOnAtSpeedStandsAtTheFirstBlockEndItCan) {
  TestMachine test;
  for (int i = 1; i <= 1000; ++i) test.program.line(0, i * 0.05, 1200);
  test.machine.poll(Seconds{1});
  OperatorPanel panel;
  panel.single_block = true;
  test.machine.set_panel(panel);
  test.run_all();
  EXPECT_EQ(test.machine.state(), MachineState::SingleBlock);
  EXPECT_NEAR(test.z(), 20.025, 0.026);  // 0.2 mm of slowing down, then the next block end
  EXPECT_FALSE(test.machine.is_moving());
}

TEST(Stops, ProgramStopWaitsForResume) {
  TestMachine test;
  test.program.stop();
  test.program.output("after");
  test.run_all();
  EXPECT_EQ(test.recorder.lines, (std::vector<std::string>{"stop", "block 1"}));
  EXPECT_EQ(test.machine.state(), MachineState::ProgramStop);
  EXPECT_TRUE(test.machine.resume());
  test.run_all();
  EXPECT_EQ(test.recorder.lines.back(), "block 2");
}

TEST(Stops, OptionalStopNeedsItsSwitch) {
  TestMachine test;
  test.program.stop(interpreter::StopKind::Optional);
  test.run_all();
  EXPECT_EQ(test.recorder.lines, std::vector<std::string>{"block 1"});
  OperatorPanel panel;
  panel.optional_stop = true;
  test.machine.set_panel(panel);
  test.program.stop(interpreter::StopKind::Optional);
  test.run_all();
  EXPECT_EQ(test.machine.state(), MachineState::OptionalStop);
}

TEST(Stops, ToolChangeIsToldAndWaitsOnlyWhereTheMachineIsSetSo) {
  for (const bool waits : {false, true}) {
    MachineLimits limits = plain_lathe();
    limits.waits_at_tool_change = waits;
    TestMachine test(limits);
    test.program.stop(interpreter::StopKind::ToolChange);
    test.run_all();
    EXPECT_EQ(test.recorder.lines.front(), "stop");
    EXPECT_EQ(test.machine.state(), waits ? MachineState::ProgramStop : MachineState::Idle);
  }
}

TEST(Resume, SaysWhenThereWasNothingToResume) {
  TestMachine test;
  EXPECT_FALSE(test.machine.resume());
}

TEST(Abort, SlowsDownThenDiscardsEverything) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.program.output("never");
  test.machine.poll(Seconds{1});
  test.machine.abort();
  EXPECT_TRUE(test.recorder.lines.empty());
  EXPECT_NEAR(test.run_all(), 0.02, 1e-9);
  EXPECT_EQ(test.recorder.lines, std::vector<std::string>{"aborted"});
  EXPECT_NEAR(test.z(), 20, 1e-9);
  EXPECT_EQ(test.machine.state(), MachineState::Aborted);
  test.program.output("dropped");
  test.run_all();
  EXPECT_EQ(test.recorder.lines.size(), 1u);
}

TEST(Abort, AtRestIsImmediateAndBeginIsTheWayOn) {
  TestMachine test;
  test.program.stop();
  test.run_all();
  test.machine.abort();
  EXPECT_EQ(test.recorder.lines.back(), "aborted");
  test.machine.begin(Program::at(1, 2));
  EXPECT_EQ(test.machine.state(), MachineState::Idle);
  EXPECT_EQ(test.machine.status().executed, 0u);
  test.program.line(1, 12, 1200);
  EXPECT_NEAR(test.run_all(), trapezoid(10, 20, 1000), 1e-9);
}

}  // namespace
}  // namespace dripline::machine::test
