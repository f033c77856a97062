// LinuxCNC stops by itself, ends, or cannot be reached any more.
#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/integration/linuxcnc/linuxcnc_shop.hpp"

namespace dripline::integration {
namespace {

/// The child of this process that is the helper.
pid_t helper() {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0) continue;
    std::string name, state;
    int number = 0, parent = 0;
    std::ifstream(entry.path() / "stat") >> number >> name >> state >> parent;
    if (parent == ::getpid() && name == "(python3)" && state != "Z") return pid;
  }
  return 0;
}

constexpr double kMillimetersInASecond = 50;

class LinuxCncFaults : public LinuxCncTest {
 protected:
  void start_long_program() {
    begin();
    for (int i = 1; i <= 390; ++i) program->line(i, 0, kMillimetersInASecond * 60);
    ASSERT_TRUE(wait([&] { return recorder.blocks.size() > 10; })) << alarm();
  }
  /// One move is one millimeter.
  void expect_honest_counter() {
    const auto truth = static_cast<std::uint64_t>(x() + 0.001);
    EXPECT_LE(recorder.blocks.back(), truth + 1);
    EXPECT_GE(recorder.blocks.back() + 1, truth) << "a block's end between two reports";
    EXPECT_LT(truth, 390U) << "the axes were stopped";
  }
  void expect_restart() {
    runs = false;
    EXPECT_NE(refusal().find("press and release the emergency stop"), std::string::npos);
    press_emergency_stop(true);
    press_emergency_stop(false);
    EXPECT_TRUE(wait([&] { return machine->unlock().has_value(); })) << refusal();
    EXPECT_TRUE(wait([&] { return refusal(machine->status().position).empty(); })) << refusal();
    const double at = x();
    begin();
    program->line(at - 5, 0, 6000);
    program->end();
    EXPECT_TRUE(wait_over());
    EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
    EXPECT_TRUE(rests()) << "the witness has written what it saw";
    EXPECT_NEAR(x(), at - 5, 0.001);
  }
};

TEST_F(LinuxCncFaults, ItsOwnErrorIsAnAlarmWithItsText) {
  begin();
  program->line(5, 0, 6000);
  machine->events().on_tool({.origin = program->begin_block(), .number = 99, .offset = {}});
  program->end_block();
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Alarmed);
  EXPECT_NE(alarm().find("LCN0001"), std::string::npos) << alarm();
  EXPECT_NE(alarm().find("error 11 of LinuxCNC, "), std::string::npos) << alarm();
  EXPECT_NE(alarm().find("99"), std::string::npos) << alarm();
}

TEST_F(LinuxCncFaults, ALostHelperIsAnAlarmAndStopsTheAxes) {
  start_long_program();
  ASSERT_GT(helper(), 0);
  ::kill(helper(), SIGKILL);
  ASSERT_TRUE(wait_over());
  EXPECT_NE(alarm().find("LCN0005 the helper has ended: the position is unknown"),
            std::string::npos)
      << alarm();
  ASSERT_TRUE(rests());
  expect_honest_counter();
  expect_restart();
}

/// What the motion process has would take seconds.
TEST_F(LinuxCncFaults, AnEndedTaskIsAnAlarmAndStopsTheAxes) {
  connect({.seconds_ahead = 60});
  start_long_program();
  linuxcnc->kill("milltask");
  ASSERT_TRUE(wait_over());
  EXPECT_NE(alarm().find("LCN0005 LinuxCNC has ended: the position is unknown"), std::string::npos)
      << alarm();
  runs = false;
  ASSERT_TRUE(rests());
  expect_honest_counter();
  EXPECT_NE(refusal(), "") << "nothing starts any more";
}

/// Nothing is left that could stop the motion process: it has no more than a second.
TEST_F(LinuxCncFaults, WithoutTaskAndHelperTheAxesStopSoon) {
  start_long_program();
  const double at = x();
  ::kill(helper(), SIGKILL);
  linuxcnc->kill("milltask");
  ASSERT_TRUE(wait_over());
  ASSERT_TRUE(rests());
  EXPECT_LT(x(), at + kMillimetersInASecond * 2);
  EXPECT_LT(x(), 389);
}

/// LinuxCNC has it open, and needs its name no more.
TEST_F(LinuxCncFaults, AProgramLeavesNoFileBehindWhateverEnds) {
  const test_support::TemporaryFolder folder;
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  start_long_program();
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(LinuxCncFaults, AnEndedMotionProcessIsAnAlarm) {
  start_long_program();
  linuxcnc->kill("rtapi_app");
  ASSERT_TRUE(wait_over());
  EXPECT_NE(alarm().find("LCN0005"), std::string::npos) << alarm();
  ASSERT_TRUE(rests());
  expect_honest_counter();
}

TEST_F(LinuxCncFaults, TheEmergencyStopEndsTheProgram) {
  start_long_program();
  auto panel = machine->panel();
  panel.emergency_stop = true;
  machine->set_panel(panel);
  ASSERT_TRUE(rests());
  EXPECT_EQ(machine->state(), MachineState::EmergencyStop);
  panel.emergency_stop = false;
  machine->set_panel(panel);
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Aborted) << alarm();
  EXPECT_LE(recorder.blocks.back(), static_cast<std::uint64_t>(x() + 0.001) + 1);
}

/// What is needed for a jog are several commands, and each waits for LinuxCNC.
TEST_F(LinuxCncFaults, AnEmergencyStopOvertakesAJogThatLinuxCncHasNotTaken) {
  const double at = x();
  linuxcnc->kill("milltask", "-STOP");
  ASSERT_TRUE(
      machine->jog({.axis = interpreter::Axis::X, .distance = 50, .feed_per_minute = 6000}));
  std::this_thread::sleep_for(500ms);
  press_emergency_stop(true);
  linuxcnc->kill("milltask", "-CONT");
  ASSERT_TRUE(wait([&] { return !machine->is_jogging(); }));
  EXPECT_TRUE(wait([&] { return refusal().find("emergency stop") != std::string::npos; }))
      << refusal();
  ASSERT_TRUE(rests());
  EXPECT_EQ(x(), at);
}

TEST_F(LinuxCncFaults, ABackEndThatEndsStopsTheAxes) {
  start_long_program();
  machine.reset();
  runs = false;
  ASSERT_TRUE(rests());
  EXPECT_LT(x(), 200) << "it does not run out what it has";
}

}  // namespace
}  // namespace dripline::integration
