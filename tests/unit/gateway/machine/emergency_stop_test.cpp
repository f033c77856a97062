#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/gateway/machine/test_machine.hpp"

/// The panel's emergency stop. Row: HD-195.
namespace dripline::machine::test {
namespace {

void set_emergency_stop(TestMachine& test, bool is_pressed) {
  OperatorPanel panel = test.machine.panel();
  panel.emergency_stop = is_pressed;
  test.machine.set_panel(panel);
}

void coolant(TestMachine& test, bool flood) {
  const Origin origin = test.program.begin_block();
  test.machine.events().on_coolant({origin, flood, false});
  test.program.end_block();
}

std::size_t count_of(const TestMachine& test, std::string_view line) {
  return static_cast<std::size_t>(
      std::count(test.recorder.lines.begin(), test.recorder.lines.end(), line));
}

TEST(EmergencyStop, BrakesAtOnceAndStandsUntilItIsReleased) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});  // 19.8 mm done, at 20 mm/s
  set_emergency_stop(test, true);
  EXPECT_EQ(test.machine.state(), MachineState::EmergencyStop);
  EXPECT_NEAR(test.run_all(), 0.02, 1e-9);
  EXPECT_FALSE(test.machine.is_moving());
  EXPECT_NEAR(test.z(), 20, 1e-9);
  EXPECT_FALSE(test.machine.resume());
  EXPECT_EQ(test.machine.poll(Seconds{5}).count(), 0);
  EXPECT_EQ(test.machine.state(), MachineState::EmergencyStop);
  EXPECT_TRUE(test.recorder.lines.empty());
}

TEST(EmergencyStop, EndsTheProgramWhenItIsReleased) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});
  set_emergency_stop(test, true);
  test.run_all();
  set_emergency_stop(test, false);
  EXPECT_EQ(test.recorder.lines, std::vector<std::string>{"aborted"});
  EXPECT_EQ(test.machine.state(), MachineState::Aborted);
  EXPECT_FALSE(test.machine.resume());
  EXPECT_EQ(test.run_all(), 0);
  EXPECT_NEAR(test.z(), 20, 1e-9);
}

TEST(EmergencyStop, ReleasedTooSoonComesToRestFirst) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});
  set_emergency_stop(test, true);
  test.machine.poll(Seconds{0.01});
  set_emergency_stop(test, false);
  EXPECT_EQ(test.machine.state(), MachineState::EmergencyStop);
  EXPECT_TRUE(test.recorder.lines.empty());
  EXPECT_NEAR(test.run_all(), 0.01, 1e-9);
  EXPECT_EQ(test.machine.state(), MachineState::Aborted);
}

/// A hold would let it finish.
TEST(EmergencyStop, BrakesAThread) {
  TestMachine test;
  test.program.spindle(600);
  test.program.thread(0, 100, 2);  // 20 mm/s
  test.machine.poll(Seconds{1});
  set_emergency_stop(test, true);
  EXPECT_NEAR(test.run_all(), 0.02, 1e-9);
  EXPECT_LT(test.z(), 21);
}

TEST(EmergencyStop, InterruptsADwell) {
  TestMachine test;
  test.program.dwell(5);
  test.machine.poll(Seconds{1});
  set_emergency_stop(test, true);
  EXPECT_EQ(test.machine.poll(Seconds{9}).count(), 0);
  EXPECT_NEAR(test.machine.status().dwell_left.count(), 4, 1e-9);
}

/// Blocks that are crossed while the axes brake turn nothing on again.
TEST(EmergencyStop, TurnsSpindleAndCoolantOffForGood) {
  TestMachine test;
  test.program.spindle(600);
  for (int i = 1; i <= 1000; ++i) {
    coolant(test, true);
    test.program.spindle(600);
    test.program.line(0, i * 0.05, 1200);
  }
  test.machine.poll(Seconds{1});
  ASSERT_TRUE(test.machine.status().flood);
  ASSERT_EQ(test.machine.status().spindle_rpm, 600);
  const auto blocks = test.recorder.blocks.size();
  test.recorder.lines.clear();
  test.recorder.writes_blocks = false;
  set_emergency_stop(test, true);
  EXPECT_EQ(test.recorder.lines, (std::vector<std::string>{"spindle", "coolant false false"}));
  EXPECT_EQ(test.machine.status().spindle_rpm, 0);
  test.run_all();
  EXPECT_GT(test.recorder.blocks.size(), blocks + 6) << "no block was crossed";
  EXPECT_EQ(test.recorder.lines.size(), 2U);
  EXPECT_FALSE(test.machine.status().flood);
  EXPECT_EQ(test.machine.status().spindle_rpm, 0);
}

TEST(EmergencyStop, TurnsOffWhatAProgramLeftOn) {
  TestMachine test;
  test.program.spindle(600);
  test.program.end();
  test.run_all();
  ASSERT_EQ(test.machine.status().spindle_rpm, 600);
  set_emergency_stop(test, true);
  EXPECT_EQ(test.machine.status().spindle_rpm, 0);
  set_emergency_stop(test, false);
  EXPECT_EQ(test.machine.state(), MachineState::Completed);
  EXPECT_EQ(count_of(test, "aborted"), 0U);
}

TEST(EmergencyStop, EndsAProgramThatStandsOrStarves) {
  for (const bool is_stopped : {false, true}) {
    TestMachine test;
    test.program.line(0, 10, 1200);
    if (is_stopped) test.program.stop();
    test.run_all();
    ASSERT_EQ(test.machine.state(), is_stopped ? MachineState::ProgramStop : MachineState::Idle);
    set_emergency_stop(test, true);
    EXPECT_EQ(test.machine.state(), MachineState::EmergencyStop);
    set_emergency_stop(test, false);
    EXPECT_EQ(test.machine.state(), MachineState::Aborted);
    EXPECT_EQ(count_of(test, "aborted"), 1U);
  }
}

TEST(EmergencyStop, LetsNothingBeginWhileItIsPressed) {
  TestMachine test;
  set_emergency_stop(test, true);
  test.machine.begin(Program::at(0, 0));
  test.program.spindle(600);
  test.program.line(0, 10, 1200);
  EXPECT_EQ(test.run_all(), 0);
  EXPECT_EQ(test.machine.state(), MachineState::EmergencyStop);
  EXPECT_TRUE(test.recorder.lines.empty());
  set_emergency_stop(test, false);
  test.machine.begin(Program::at(0, 0));
  test.program.line(0, 10, 1200);
  test.run_all();
  EXPECT_EQ(test.z(), 10);
}

/// A wheel at rest would keep it from slowing down.
TEST(EmergencyStop, BrakesWhatTheHandwheelDrives) {
  TestMachine test;
  OperatorPanel panel;
  panel.handwheel = true;
  test.machine.set_panel(panel);
  test.program.line(0, 100, 1200);
  test.machine.turn_handwheel(Seconds{1});
  test.machine.poll(Seconds{0.5});
  set_emergency_stop(test, true);
  EXPECT_NEAR(test.run_all(), 0.02, 1e-9);
  test.machine.turn_handwheel(Seconds{1});
  EXPECT_EQ(test.run_all(), 0);
}

TEST(EmergencyStop, EndsAnAbortThatWasUnderWay) {
  TestMachine test;
  test.program.line(0, 100, 1200);
  test.machine.poll(Seconds{1});
  test.machine.abort();
  set_emergency_stop(test, true);
  test.run_all();
  EXPECT_EQ(count_of(test, "aborted"), 0U);
  set_emergency_stop(test, false);
  EXPECT_EQ(count_of(test, "aborted"), 1U);
}

}  // namespace
}  // namespace dripline::machine::test
