#include <gtest/gtest.h>

#include "gateway/interpreter/registry.hpp"
#include "tests/unit/gateway/interpreter/dialects/fanuc/program_run.hpp"

/// Blocks in the text: lines, semicolons, lengths, ends.

namespace dripline::interpreter {

// Which control a text is for.

namespace {

std::string first_candidate(std::string_view head) {
  const auto found = detect_dialect(head, "program");
  return found.empty() ? "" : std::string(found.front()->name);
}

TEST(FanucDetection, MacroProgramsAreRecognized) {
  EXPECT_EQ(first_candidate("%\nO1234 (PLATE)\nG21 G90 G54\nG43 H1 Z50.\n#101=3.\nM98 P8000\n"),
            "fanuc");
  EXPECT_EQ(first_candidate("O9100\nIF[#1EQ#0]GOTO10\nPOPEN\nDPRNT[X#1[53]]\nPCLOS\nM99\n"),
            "fanuc");
  EXPECT_EQ(first_candidate("O0009\n#2=4.5\nPOPEN\nDPRNT[**SUM*#2[33]]\nPCLOS\nM30\n"), "fanuc");
  EXPECT_EQ(first_candidate(":0007\nG00 G90 X0 Y0\nG81 X1. Y1. Z-1. R.1 F5.\nM30\n"), "fanuc");
}

TEST(FanucDetection, TextsOfOthersAreLeftToThem) {
  EXPECT_NE(first_candidate("0 BEGIN PGM 17 MM\n1 TOOL CALL 1 Z S1000\n"), "fanuc");
  EXPECT_NE(first_candidate("o100 sub\nG1 X#<width> F10\no100 endsub\nM2\n"), "fanuc");
  EXPECT_NE(first_candidate("O0100\nG20 G93\nP156=3\nGOSUB 10\n"), "fanuc");
}

}  // namespace

}  // namespace dripline::interpreter

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
