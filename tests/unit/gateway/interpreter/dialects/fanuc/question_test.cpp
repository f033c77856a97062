#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/fanuc/program_run.hpp"

/// A question suspends the block; the answer takes it up without doing anything twice.
namespace dripline::interpreter::fanuc {
namespace {

TEST(FanucQuestions, EveryInputIsAskedForOnceAndTheBlockIsExecutedOnce) {
  ProgramRun run("POPEN\n#1=#1000*10+#1001\nDPRNT[#1[20]]\nPCLOS\nM30\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 1000);
  ASSERT_TRUE(run.interpreter().answer(true));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 1001);
  ASSERT_TRUE(run.interpreter().answer(true));
  EXPECT_EQ(run.step(), StepState::Ended);
  ASSERT_EQ(run.events("output").size(), 1U);
  EXPECT_NE(run.events("output")[0].find(" 11"), std::string::npos);
}

TEST(FanucQuestions, TheStepAsksAgainUntilItIsAnswered) {
  ProgramRun run("G00 X[#1005]\nM30\n");
  EXPECT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(run.interpreter().blocks(), 0U);
}

TEST(FanucQuestions, AnAnswerOfAnotherKindLeavesTheQuestionOpen) {
  ProgramRun run("#1=#3012\nM30\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_FALSE(run.interpreter().answer(true));
  EXPECT_FALSE(run.interpreter().answer(PromptAnswer{"1"}));
  ASSERT_TRUE(run.interpreter().answer(LocalTime{2026, 1, 2, 3, 4, 5}));
  EXPECT_EQ(run.step(), StepState::Ended);
}

TEST(FanucQuestions, ASkipMoveWhoseTargetNeededAnInputAsksForBoth) {
  ProgramRun run("G01 F100\nG31 X[10*#1002]\nM30\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(true));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  const Probe probe = std::get<ProbeQuestion>(run.interpreter().question()).probe;
  EXPECT_DOUBLE_EQ(probe.to.linear(Axis::X).mm(), 10);
  ProbeResult result{true, probe.from};
  result.at.set(Axis::X, Length::mm(4));
  ASSERT_TRUE(run.interpreter().answer(result));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("probe").size(), 1U);
}

/// FAN-076
TEST(FanucQuestions, TheTimerCountsMillisecondsAndGoesOnAfterMidnight) {
  ProgramRun run(
      "#3001=20\n#1=#3001\n#2=#3001\nPOPEN\nDPRNT[#1[80]*#2[80]*#3011[80]*#3012[60]]\nM30\n");
  const LocalTime before{2026, 12, 31, 23, 59, 59, 750}, after{2027, 1, 1, 0, 0, 0, 500};
  for (const LocalTime& now : {before, before, after, after, after}) {
    ASSERT_EQ(run.step(), StepState::NeedsAnswer);
    ASSERT_TRUE(run.interpreter().answer(now));
  }
  ASSERT_EQ(run.step(), StepState::Ended);
  ASSERT_EQ(run.printed().size(), 1U);
  EXPECT_NE(run.printed()[0].find(" 20 "), std::string::npos) << run.printed()[0];
  EXPECT_NE(run.printed()[0].find(" 770 "), std::string::npos) << run.printed()[0];
  EXPECT_NE(run.printed()[0].find("20270101"), std::string::npos) << run.printed()[0];
}

/// FAN-076
TEST(FanucQuestions, TheTimerReadFirstIsThatOfTheDay) {
  ProgramRun run("#1=#3001\n#2=#3001\n#3=#3001\nPOPEN\nDPRNT[#1[80]*#2[80]*#3[80]]\nM30\n");
  const LocalTime first{2026, 1, 2, 0, 0, 1, 5}, next_day{2026, 1, 3, 0, 0, 1, 6};
  for (const LocalTime& now : {first, next_day, LocalTime{2026, 1, 1, 12, 0, 0, 0}}) {
    ASSERT_EQ(run.step(), StepState::NeedsAnswer);
    ASSERT_TRUE(run.interpreter().answer(now));
  }
  ASSERT_EQ(run.step(), StepState::Ended);
  EXPECT_NE(run.printed()[0].find(" 1005 "), std::string::npos) << run.printed()[0];
  EXPECT_NE(run.printed()[0].find(" 86401006 "), std::string::npos) << run.printed()[0];
  EXPECT_TRUE(run.printed()[0].find(" 0") != std::string::npos) << "a clock that was set back";
}

/// FAN-076
TEST(FanucQuestions, ATimerBeyondItsRangeIsRefused) {
  ProgramRun run("#3001=2147483648\nM30\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(LocalTime{2026, 1, 2, 3, 4, 5}));
  ASSERT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("PS115")) << run.alarm();
}

/// FAN-094
TEST(FanucQuestions, AMeasurementAsksOnceAndCorrectsTheOffsetByTheAnswer) {
  const auto setup = parse_setup(
      "[control]\ng37_clearance = 10\ng37_tolerance = 5\ng37_feed = 50\n"
      "[[tool]]\nnumber = 3\nlength = 100\n");
  ASSERT_TRUE(setup) << setup.error().what;
  ProgramRun run("G43 H3 G00 Z50.\nG37 Z0\nPOPEN\nDPRNT[#2003[41]]\nM30\n", *setup);
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  const Probe probe = std::get<ProbeQuestion>(run.interpreter().question()).probe;
  EXPECT_DOUBLE_EQ(probe.from.linear(Axis::Z).mm(), 10);
  EXPECT_DOUBLE_EQ(probe.to.linear(Axis::Z).mm(), -5);
  EXPECT_EQ(probe.feed, Feed::per_minute(Length::mm(50)));
  ProbeResult result{true, probe.from};
  result.at.set(Axis::Z, Length::mm(-2.5));
  ASSERT_TRUE(run.interpreter().answer(result));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("probe").size(), 1U);
  ASSERT_EQ(run.printed().size(), 1U);
  EXPECT_NE(run.printed()[0].find("97.5"), std::string::npos) << run.printed()[0];
}

TEST(FanucQuestions, AMeasurementWithoutASignalIsAnAlarm) {
  const auto setup =
      parse_setup("[control]\ng37_clearance = 10\ng37_tolerance = 5\ng37_feed = 50\n");
  ASSERT_TRUE(setup) << setup.error().what;
  ProgramRun run("G43 H3 G00 Z50.\nG37 Z0\nM30\n", *setup);
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  const Probe probe = std::get<ProbeQuestion>(run.interpreter().question()).probe;
  ASSERT_TRUE(run.interpreter().answer(ProbeResult{false, probe.to}));
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("PS080")) << run.alarm();
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
