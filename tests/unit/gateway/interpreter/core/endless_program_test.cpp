#include <gtest/gtest.h>
#include <string>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/language/loop_guard.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// Programs that repeat without end. Rows: FAN-062, NGC-088.
namespace dripline::interpreter {
namespace {

struct Loop {
  const char* name;
  const char* control;
  const char* program;
  const char* alarm;  ///< where nothing moves
};

/// M99 is LinuxCNC's.
Setup setup_for(std::string_view control) {
  return control == "rs274ngc" ? parse_setup("[control]\nprofile = \"linuxcnc\"\n").value()
                               : Setup{};
}

class AlarmIds final : public EventSink {
 public:
  void on_alarm(const Alarm& event) override { id = event.diagnostic.id; }
  std::string id;
};

constexpr std::uint64_t kMaxBlocks = 8 * language::LoopGuard::kMaxIdlePasses;

class IdleLoop : public testing::TestWithParam<Loop> {};

TEST_P(IdleLoop, EndsWithAnAlarm) {
  MemorySource source(GetParam().program);
  AlarmIds sink;
  auto made =
      (*find_dialect(GetParam().control))->make(setup_for(GetParam().control), source, sink);
  ASSERT_TRUE(made) << made.error().what;
  Interpreter& run = **made;
  StepState state = StepState::Ran;
  while (state == StepState::Ran && run.blocks() < kMaxBlocks) state = run.step(65'536);
  EXPECT_EQ(state, StepState::Alarmed) << run.blocks();
  EXPECT_EQ(sink.id, GetParam().alarm);
}

INSTANTIATE_TEST_SUITE_P(
    , IdleLoop,
    testing::Values(
        Loop{"centurion_goto", "centurion", "N1 GOTO 1\n", "CEN1012"},
        Loop{"centurion_while", "centurion", "WHILE 1<2\nP1=P1+1\nWEND\n", "CEN1012"},
        Loop{"tnc155_jump", "tnc155",
             "0 BEGIN PGM 1 MM\n1 LBL 1\n2 FN 9: IF +0 EQU +0 GOTO LBL 1\n3 END PGM 1 MM\n",
             "TNC-LOOP-LIMIT"},
        Loop{"fanuc_goto", "fanuc", "N1 GOTO1\n", "loop-limit"},
        Loop{"fanuc_main_program", "fanuc", "#1=1\nM99\n", "loop-limit"},
        Loop{"rs274ngc_main_program", "rs274ngc", "F100\nM99\n", "NGC0300"}),
    [](const auto& row) { return std::string{row.param.name}; });

class MovingLoop : public testing::TestWithParam<Loop> {};

/// At a machine: part after part.
TEST_P(MovingLoop, RunsOnAtAMachine) {
  const Loop& loop = GetParam();
  MemorySource source(loop.program);
  AlarmIds sink;
  auto made = (*find_dialect(loop.control))->make(setup_for(loop.control), source, sink);
  ASSERT_TRUE(made) << made.error().what;
  Interpreter& run = **made;
  // each pass is three or four blocks: more passes than an idle loop may make
  const std::uint64_t enough = 4 * language::LoopGuard::kMaxIdlePasses + 1'000'000;
  StepState state = StepState::Ran;
  while (state == StepState::Ran && run.blocks() < enough) state = run.step(65'536);
  EXPECT_EQ(state, StepState::Ran) << sink.id;
}

TEST_P(MovingLoop, EndsOffline) {
  const Loop& loop = GetParam();
  MemorySource source(loop.program);
  AlarmIds sink;
  const auto outcome = run_offline(**find_dialect(loop.control), setup_for(loop.control), source,
                                   sink, {.max_repeated_blocks = 100'000});
  ASSERT_TRUE(outcome) << outcome.error().what;
  EXPECT_FALSE(outcome->ended);
  ASSERT_TRUE(outcome->alarm);
  EXPECT_EQ(outcome->alarm->id, "OFF0001");
  EXPECT_EQ(sink.id, "OFF0001");
  EXPECT_LT(outcome->blocks, 300'000U);
}

INSTANTIATE_TEST_SUITE_P(
    , MovingLoop,
    testing::Values(
        Loop{"centurion", "centurion", "G0\nN1 X1\nX0\nGOTO 1\n", ""},
        Loop{"tnc155", "tnc155",
             "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+1\n2 TOOL CALL 1 Z S100\n3 LBL 1\n4 L X+1 Y+0 "
             "R0 F100\n5 L X+0 Y+0\n6 FN 9: IF +0 EQU +0 GOTO LBL 1\n7 END PGM 1 MM\n",
             ""},
        Loop{"fanuc_goto", "fanuc", "G0\nN1X1.\nX0\nGOTO1\n", ""},
        Loop{"fanuc_main_program", "fanuc", "G0X1.\nX0\nM99\n", ""},
        Loop{"rs274ngc_main_program", "rs274ngc", "G0 X1\nX0\nM99\n", ""}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(EndlessProgram, WhatIsExecutedOnceDoesNotCount) {
  std::string program;
  for (int i = 0; i < 1000; ++i) program += "G0X" + std::to_string(i) + ".\n";
  program += "M30\n";
  MemorySource source(program);
  EventSink sink;
  const auto outcome =
      run_offline(**find_dialect("fanuc"), {}, source, sink, {.max_repeated_blocks = 0});
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->ended);
}

}  // namespace
}  // namespace dripline::interpreter
