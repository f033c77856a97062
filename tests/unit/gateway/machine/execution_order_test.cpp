#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

TEST(Execution, CountsEveryBlockExactlyOnceAndInOrder) {
  TestMachine test;
  for (int i = 1; i <= 500; ++i) {
    if (i % 7 == 0)
      test.program.empty();
    else if (i % 5 == 0)
      test.program.output("x");
    else
      test.program.line(0, i, 1200);
  }
  test.run_all();
  ASSERT_EQ(test.recorder.blocks.size(), 500u);
  for (std::size_t i = 0; i < 500; ++i) EXPECT_EQ(test.recorder.blocks[i], i + 1);
  EXPECT_EQ(test.machine.status().executed, 500u);
  EXPECT_TRUE(test.machine.drained());
}

TEST(Execution, OutputIsToldOnlyAfterTheMotionBeforeIt) {
  TestMachine test;
  test.program.line(0, 10, 600);
  test.program.output("done");
  test.program.line(0, 0, 600);
  test.machine.poll(Seconds{0.9});
  EXPECT_TRUE(test.recorder.lines.empty());
  test.machine.poll(Seconds{0.2});
  EXPECT_EQ(test.recorder.lines, (std::vector<std::string>{"block 1", "output done", "block 2"}));
}

TEST(Execution, BlockOfSeveralMovesIsDoneAfterItsLast) {
  TestMachine test;
  const Origin& origin = test.program.begin_block();
  test.machine.events().on_rapid({origin, Program::at(0, 10)});
  test.machine.events().on_rapid({origin, Program::at(10, 10)});
  test.program.end_block();
  test.machine.poll_all(1);
  EXPECT_TRUE(test.recorder.blocks.empty());
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), 1u);
}

TEST(Execution, BlockEndThatComesLateIsStillCounted) {
  TestMachine test;
  const Origin& origin = test.program.begin_block();
  test.machine.events().on_rapid({origin, Program::at(0, 10)});
  test.run_all();
  EXPECT_TRUE(test.recorder.blocks.empty());
  test.program.end_block();
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), 1u);
}

TEST(Execution, EverythingIsToldInTheOrderOfTheProgram) {
  TestMachine test;
  auto& events = test.machine.events();
  const Origin& o = test.program.begin_block();
  events.on_open({o, interpreter::OutputDevice::File, "PROFILE"});
  events.on_open({o, interpreter::OutputDevice::Port1, std::nullopt});
  events.on_coolant({o, true, false});
  events.on_tool({o, 7, false, std::nullopt});
  events.on_miscellaneous({o, 62});
  events.on_pin({o, Axis::X, 3, true, std::nullopt});
  events.on_message({o, "look"});
  events.on_warning({o, {.id = "CEN0001", .text = "odd", .line = 1}});
  events.on_close({o, interpreter::OutputDevice::File});
  test.program.end_block();
  test.program.end();
  test.run_all();
  EXPECT_EQ(test.recorder.lines,
            (std::vector<std::string>{
                "open PROFILE", "open -", "coolant true false", "tool 7", "misc 62", "pin 3 true",
                "message look", "warning CEN0001 odd", "close", "block 1", "block 2", "end"}));
  EXPECT_EQ(test.machine.state(), MachineState::Completed);
}

TEST(Execution, AlarmEndsEverythingAfterIt) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  const Origin& origin = test.program.begin_block();
  test.machine.events().on_alarm({origin, {.id = "CEN0103", .text = "no such code", .line = 2}});
  test.program.output("never");
  EXPECT_NEAR(test.run_all(), trapezoid(10, 20, 1000), 1e-9);
  EXPECT_EQ(test.recorder.lines,
            (std::vector<std::string>{"block 1", "alarm CEN0103 no such code"}));
  EXPECT_EQ(test.machine.state(), MachineState::Alarmed);
  test.program.output("dropped");
  test.run_all();
  EXPECT_EQ(test.recorder.lines.size(), 2u);
  EXPECT_FALSE(test.machine.resume());
}

TEST(Execution, MotionIsAnnouncedAfterWhatWasToldBeforeIt) {
  struct Announcer final : ExecutionSink {
    std::vector<std::string> lines;
    bool on_motion_starts(const Origin& o) override {
      lines.push_back(fmt::format("motion {}", o.block));
      return true;
    }
    void on_output(const interpreter::Output& o) override { lines.emplace_back(o.text); }
  } announcer;
  SimulatedMachine machine(plain_lathe(), {}, announcer);
  Program program(machine.events());
  program.output("a");
  program.line(0, 1, 600);
  program.output("b");
  program.dwell(1);
  machine.poll_all();
  EXPECT_EQ(announcer.lines, (std::vector<std::string>{"a", "motion 2", "b", "motion 4"}));
}

TEST(Execution, NothingBeginsBeforeWhatWasToldIsWritten) {
  TestMachine test;
  test.recorder.is_disk_full = true;
  test.program.line(0, 1, 600);
  test.program.dwell(1);
  EXPECT_EQ(test.run_all(), 0);
  EXPECT_TRUE(test.recorder.blocks.empty());
  test.recorder.is_disk_full = false;
  EXPECT_GT(test.run_all(), 1);
  EXPECT_EQ(test.recorder.blocks.size(), 2u);
  test.recorder.is_disk_full = true;
  test.program.line(0, 2, 600);
  EXPECT_EQ(test.run_all(), 0);
  test.machine.abort();
  test.run_all();
  EXPECT_EQ(test.machine.state(), MachineState::Aborted);
}

// The axes run from move to move: they come to rest along the path, and continue by themselves.
TEST(Execution, AxesThatRunComeToRestWhenWhatWasToldCannotBeWritten) {
  TestMachine test;
  test.program.line(0, 10, 1200);
  test.program.output("a");
  for (int i = 1; i <= 50; ++i) test.program.line(0, 10 + i, 1200);
  test.machine.poll(Seconds{0.3});
  ASSERT_GT(test.z(), 1);
  test.recorder.is_disk_full = true;
  test.run_all();
  constexpr double kBraking = 0.2;  // mm, from 20 mm/s at 1000 mm/s^2
  EXPECT_NEAR(test.z(), 10 + kBraking, 1e-6);
  EXPECT_FALSE(test.machine.is_moving());
  EXPECT_EQ(test.recorder.blocks.size(), 2u);
  EXPECT_EQ(test.run_all(), 0);
  test.recorder.is_disk_full = false;
  test.run_all();
  EXPECT_NEAR(test.z(), 60, 1e-9);
  EXPECT_EQ(test.recorder.blocks.size(), 52u);
}

// Moves that are shorter than the distance to rest.
TEST(Execution, AxesComeToRestOverShortMovesWhenWhatWasToldCannotBeWritten) {
  TestMachine test;
  for (int i = 1; i <= 400; ++i) test.program.line(0, 0.05 * i, 1200);
  test.machine.poll(Seconds{0.3});
  const double at = test.z();
  ASSERT_GT(at, 1);
  test.recorder.is_disk_full = true;
  test.run_all();
  EXPECT_GT(test.z(), at);
  EXPECT_LT(test.z(), at + 0.05 + 0.2 + 1e-6);
  test.machine.hold();
  test.recorder.is_disk_full = false;
  EXPECT_EQ(test.run_all(), 0) << "held by the operator";
  EXPECT_TRUE(test.machine.resume());
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), 400u);
}

TEST(Execution, AThreadIsCutToItsEndWhenWhatWasToldCannotBeWritten) {
  TestMachine test;
  test.program.spindle(600);
  test.program.line(0, 1, 600);
  test.program.thread(0, 10, 1);
  test.program.line(0, 30, 600);
  test.machine.poll(Seconds{0.05});
  test.recorder.is_disk_full = true;
  test.run_all();
  EXPECT_GE(test.z(), 10 - 1e-6);
  EXPECT_LT(test.z(), 12);
}

TEST(Execution, BudgetOfActionsIsKept) {
  TestMachine test;
  for (int i = 1; i <= 100; ++i) test.program.line(0, i, 1200);
  test.machine.poll_all(30);
  EXPECT_EQ(test.recorder.blocks.size(), 30u);
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), 100u);
}

TEST(Queue, SaysWhenItIsFullAndEmptiesAgain) {
  TestMachine test;
  std::size_t blocks = 0;
  while (test.machine.has_room()) test.program.line(0, static_cast<double>(++blocks), 1200);
  EXPECT_EQ(blocks, SimulatedMachine::kQueuedActions);
  test.machine.poll_all(1);
  EXPECT_TRUE(test.machine.has_room());
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), blocks);
}

TEST(Queue, IsFullOfTextToo) {
  TestMachine test;
  test.recorder.writes_blocks = false;
  const std::string text(4000, 't');
  std::size_t outputs = 0;
  for (int round = 0; round < 5; ++round) {  // round and round the ring
    while (test.machine.has_room()) {
      test.program.output(fmt::format("{} {}", outputs++, text));
    }
    test.machine.poll_all(50);
  }
  test.run_all();
  ASSERT_EQ(test.recorder.lines.size(), outputs);
  for (std::size_t i = 0; i < outputs; ++i)
    EXPECT_EQ(test.recorder.lines[i], fmt::format("output {} {}", i, text));
}

TEST(Queue, OverrunByOneBlockIsAnAlarmAndNotMemory) {
  TestMachine test;
  while (test.machine.has_room()) test.program.empty();
  const Origin& origin = test.program.begin_block();
  for (std::size_t i = 0; i < 2 * SimulatedMachine::kBlockReserve; ++i)
    test.machine.events().on_coolant({origin, i % 2 == 0, false});
  test.program.end_block();
  test.recorder.lines.clear();
  test.run_all();
  EXPECT_TRUE(test.recorder.lines.back().starts_with("alarm MCH0005"));
}

/// As a mask of FN 16 that prints much, twice in a row.
TEST(Queue, TakesWhatHasFitOnceAgain) {
  TestMachine test;
  test.recorder.writes_blocks = false;
  const std::string text(400 * 1024, 't');
  for (std::size_t times = 1; times <= 5; ++times) {
    while (!test.machine.has_room()) test.machine.poll(Seconds{1}, 1);
    test.program.output("small");
    while (!test.machine.has_room()) test.machine.poll(Seconds{1}, 1);
    test.program.output(text);
  }
  test.run_all();
  ASSERT_EQ(test.recorder.lines.size(), 10U);
  EXPECT_EQ(test.recorder.lines.back(), "output " + text);
}

TEST(Queue, OverrunByTextIsAnAlarm) {
  TestMachine test;
  const Origin& origin = test.program.begin_block();
  const std::string text(64 * 1024, 't');
  for (int i = 0; i < 20; ++i)
    test.machine.events().on_output({origin, interpreter::OutputDevice::File, text});
  test.run_all();
  EXPECT_TRUE(test.recorder.lines.back().starts_with("alarm MCH0005"));
}

}  // namespace
}  // namespace dripline::machine::test
