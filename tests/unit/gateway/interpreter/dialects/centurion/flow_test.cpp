#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

namespace dripline::interpreter::centurion {
namespace {

TEST(Steps, TheBudgetBoundsAnEndlessLoop) {
  ProgramRun run("N1 GOTO 1\n");
  EXPECT_EQ(run.step(1000), StepState::Ran);
  EXPECT_EQ(run.interpreter().blocks(), 1000U);
  ProgramRun endless("WHILE 1=1\nWEND\n");
  EXPECT_EQ(endless.step(999), StepState::Ran);
  EXPECT_EQ(endless.interpreter().blocks(), 999U);
}

TEST(Steps, OneBlockAtATimeIsTheSameAsMany) {
  const std::string text = "X1\n\nN5 Z2\nM98 P3\nX5\nM30\nO0003\nZ3\nM99\n";
  ProgramRun at_once(text);
  at_once.step();
  ProgramRun one_by_one(text);
  while (one_by_one.step(1) == StepState::Ran) {
  }
  for (const char* kind : {"line", "block", "end"}) {
    EXPECT_EQ(at_once.events(kind), one_by_one.events(kind));
  }
}

TEST(Labels, TheFirstOfTwoWinsAlsoBackwards) {
  ProgramRun run("N7 P1=P1+1\nIF P1=3 GOTO 9\nGOTO 7\nN7 PRINT[NEVER]\nN9 PRINT[#1[01]]\n");
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"3.0"});
}

TEST(Labels, BelongToTheirProgramOfTheFile) {
  ProgramRun run(
      "O0001\nM98 P2\nGOTO 5\nPRINT[NEVER]\nN5 PRINT[MAIN]\nM30\nO0002\nGOTO 5\nX9\nN5 "
      "PRINT[SUB]\n");
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), (std::vector<std::string>{"SUB", "MAIN"}));
}

TEST(Labels, InCommentsOrSkippedTextAreIgnored) {
  ProgramRun run("GOTO 5\n(N5)\nX1 N5\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN0568")) << run.alarm();
}

TEST(Labels, AreFoundFarAwayAndAgainWithoutASearch) {
  std::string text = "N1 P1=P1+1\nIF P1>200 GOTO 3\nGOTO 2\n";
  for (int i = 0; i < 100'000; ++i) text += fmt::format("N{} X{}.5\n", 10 + i % 9, i % 7);
  text += "N2 GOTO 1\nN3 PRINT[#1[01]]\n";
  ProgramRun run(text);
  StepState state = StepState::Ran;
  for (int steps = 0; state == StepState::Ran && steps < 100; ++steps) state = run.step();
  EXPECT_EQ(state, StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"201.0"});
}

TEST(Loops, LeftByGotoEnd) {
  ProgramRun run("N1 P1=P1+1\nWHILE 1=1\nIF P1<200 GOTO 1\nGOTO 9\nWEND\nN9 PRINT[#1[01]]\nWEND\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"200.0"});
  EXPECT_TRUE(run.alarm().starts_with("CEN0601")) << run.alarm();
}

TEST(Loops, WendInTextIsIgnored) {
  ProgramRun run("WHILE P1<1 (WEND)\nP1=1\nPRINT[WEND #1[01] WEND]\nWEND\n");
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"WEND 1.0 WEND"});
}

TEST(Calls, FiftyLevelsAreAllowed) {
  std::string text = "M98 P1\nM30\n";
  for (int i = 1; i < 50; ++i) text += fmt::format("O{:04}\nM98 P{}\nM99\n", i, i + 1);
  text += "O0050\nPRINT[DEEP]\n";
  ProgramRun run(text);
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  EXPECT_EQ(run.printed(), std::vector<std::string>{"DEEP"});
}

TEST(Calls, ReturnFromASubprogramDropsItsSubroutines) {
  ProgramRun run("M98 P2\nRETURN\nO0002\nGOSUB 5\nN5 M99\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN0503 2:0")) << run.alarm();
}

TEST(Calls, ZeroRepeatsIsNoCall) {
  ProgramRun run("CALL 2 L0\nM30\nO0002\nPRINT[NEVER]\n");
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_TRUE(run.printed().empty());
}

TEST(Snapshots, DamagedOrForeignOnesAreRefusedAndChangeNothing) {
  ProgramRun run("X1\nX2\nX3\n");
  run.step(1);
  const Snapshot good = run.interpreter().snapshot();
  Snapshot foreign = good;
  foreign.version += 1;
  EXPECT_EQ(run.interpreter().restore(foreign).error().code, Errc::Unsupported);
  for (std::size_t size = 0; size < good.bytes.size(); ++size) {
    Snapshot cut = good;
    cut.bytes.resize(size);
    EXPECT_EQ(run.interpreter().restore(cut).error().code, Errc::Corrupt) << size;
  }
  EXPECT_EQ(run.interpreter().snapshot().digest(), good.digest());
}

TEST(Detection, RecognizesItsOwnProgramsOnly) {
  const auto likelihood = [](std::string_view head) {
    return kCenturionDialect.likelihood(head, "program");
  };
  EXPECT_GE(likelihood("O0100\nG20 G93\nP156=3\nG0 X3 Z.1\n"), 60);
  EXPECT_EQ(likelihood("0 BEGIN PGM 17 MM\n"), 0);
  EXPECT_EQ(likelihood("#100=5\nG65 P9000\n"), 0);
}

}  // namespace
}  // namespace dripline::interpreter::centurion
