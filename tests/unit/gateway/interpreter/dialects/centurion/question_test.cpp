#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// A question suspends the block; with the answer it resumes without doing anything twice.
namespace dripline::interpreter::centurion {
namespace {

TEST(Questions, AnInputPinAsksOnceForEachUseAndRepeatsNoAssignment) {
  ProgramRun run("P1=1 P1=P1+1 P2=PIN[1000]*10+PIN[1001] P1=P1+1\nPRINT[#1 #2]\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 1000);
  ASSERT_TRUE(run.interpreter().answer(true));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 1001);
  ASSERT_TRUE(run.interpreter().answer(false));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"3.000010.0000"});
}

TEST(Questions, TheStepAsksAgainUntilItIsAnswered) {
  ProgramRun run("IF PIN[1000]=1 PRINT[ON]\n");
  EXPECT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(run.interpreter().blocks(), 0U);
}

TEST(Questions, AnAnswerOfAnotherKindLeavesTheQuestionOpen) {
  ProgramRun run("INPUT (SIZE) P5\nPRINT[#5]\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  const auto& question = std::get<PromptQuestion>(run.interpreter().question());
  EXPECT_EQ(question.text, "SIZE");
  EXPECT_EQ(question.variable, "P5");
  EXPECT_FALSE(run.interpreter().answer(true));
  EXPECT_FALSE(run.interpreter().answer(PromptAnswer{"12A"}));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(PromptAnswer{"-.5"}));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"-0.5000"});
}

TEST(Questions, EscapeEndsTheProgram) {
  ProgramRun run("INPUT (SIZE) P5 PRINT[NEVER]\nX1\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(PromptAnswer{}));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_TRUE(run.printed().empty());
  EXPECT_TRUE(run.events("line").empty());
}

TEST(Questions, TheClockIsAskedForAndTheLineIsPrintedOnce) {
  ProgramRun run("PRINT[A#1[-1] #1[-2]]\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(LocalTime{2026, 3, 4, 5, 6, 7}));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(LocalTime{2026, 3, 4, 5, 6, 7}));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"A005:06:07 26/03/04"});
}

TEST(Questions, TheNextMoveBeginsWhereAProbeMoveStopped) {
  ProgramRun run("G98 F1\nPROBE1 Z-2 M9\nG91 Z1\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  const Probe probe = std::get<ProbeQuestion>(run.interpreter().question()).probe;
  EXPECT_EQ(probe.to.linear(Axis::Z), Length::inch(-2));
  EXPECT_TRUE(run.events("coolant").empty()) << "M9 comes after the move";
  ProbeResult result{true, {}};
  result.at.set(Axis::Z, Length::inch(-0.5));
  ASSERT_TRUE(run.interpreter().answer(result));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("coolant").size(), 1U);
  EXPECT_EQ(run.events("line"), std::vector<std::string>{"Z12.7 F25.4/0/0"});
}

TEST(Questions, RandomNumbersAreDrawnOnceDespiteQuestions) {
  const std::string rest = "P3=RND[1000]\nPRINT[#2 #3]\n";
  ProgramRun plain("P2=RND[1000]+1\n" + rest);
  plain.step();
  ProgramRun asking("P2=RND[1000]+PIN[1000]\n" + rest);
  ASSERT_EQ(asking.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(asking.interpreter().answer(true));
  asking.step();
  EXPECT_EQ(plain.printed(), asking.printed());
}

}  // namespace
}  // namespace dripline::interpreter::centurion
