#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/fanuc/program_run.hpp"

/// Blocks in the text: lines, semicolons, lengths, ends.
namespace dripline::interpreter::fanuc {
namespace {

std::string alarm_of(const std::string& text) {
  ProgramRun run(text);
  run.step();
  const auto alarms = run.events("alarm");
  return alarms.empty() ? "" : alarms.front();
}

TEST(FanucText, ALineOfItsGreatestLengthIsReadAndALongerOneIsAnAlarm) {
  const std::string blanks(1024 - 2, ' ');
  EXPECT_EQ(alarm_of("M3" + blanks + "\nM30\n"), "");
  EXPECT_NE(alarm_of("M3 " + blanks + "\nM30\n").find("line-too-long"), std::string::npos);
}

TEST(FanucText, TheEndOfTheTextWithoutAnEndIsTheEndOfTheRecord) {
  EXPECT_NE(alarm_of("G00 X1.").find("PS5010"), std::string::npos);
  EXPECT_NE(alarm_of("").find("PS5010"), std::string::npos);
  EXPECT_EQ(alarm_of("G00 X1.\nM30"), "");
}

TEST(FanucText, BlocksOfOneLineHaveTheirOwnOffsets) {
  ProgramRun run("X1.;X2.;M30\n");
  EXPECT_EQ(run.step(1), StepState::Ran);
  EXPECT_EQ(run.interpreter().origin().offset, 0U);
  EXPECT_EQ(run.step(1), StepState::Ran);
  EXPECT_EQ(run.interpreter().origin().offset, 4U);
  EXPECT_EQ(run.interpreter().origin().line, 1U);
}

TEST(FanucText, PecksWithoutMeasureAreRefusedBeforeTheFirst) {
  ProgramRun run("G83 X1. Z-99999. R0 Q.001 F50 K9999\nM30\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.events("line").empty());
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
