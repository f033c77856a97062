#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/start/start_search.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// Starts elsewhere than at the first block, MDI, and what the control refuses in DNC.
namespace dripline::interpreter::centurion {
namespace {

using ControlSetup = interpreter::Setup;  // gtest keeps a private member named Setup

ControlSetup with_control(const std::string& options) {
  auto setup = parse_setup("[control]\n" + options, Units::Inch);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

/// CEN-163, CEN-206.
TEST(StartAt, IsABlockAToolALineAByteOrACount) {
  EXPECT_EQ(parse_start_at("N120")->kind, StartAt::Kind::Block);
  EXPECT_EQ(parse_start_at("N120")->number, 120U);
  EXPECT_EQ(parse_start_at("T3")->kind, StartAt::Kind::Tool);
  EXPECT_EQ(parse_start_at("L40")->kind, StartAt::Kind::Line);
  EXPECT_EQ(parse_start_at("B4096")->kind, StartAt::Kind::Byte);
  EXPECT_EQ(parse_start_at("+25")->kind, StartAt::Kind::Count);
  for (const char* text : {"", "N", "120", "N12X", "X3", "N-1", "n5"}) {
    EXPECT_FALSE(parse_start_at(text)) << text;
  }
}

TEST(StartAt, LineAndByteAreBlocksOfTheTextAndNotTheFirstExecuted) {
  const std::string text = "P140=.1\nG0 X1\nGOTO 6\n\nX2\nN6 X4\nX5\n";
  for (const char* past : {"L4", "L5", "B21", "B22"}) {
    ProgramRun run(text, with_control(std::string("start_at = \"") + past + "\""));
    EXPECT_EQ(run.step(), StepState::Alarmed) << past;
    EXPECT_NE(run.alarm().find("never comes to that block"), std::string::npos) << run.alarm();
    EXPECT_TRUE(run.events("rapid").empty()) << past;
  }
  for (const char* at : {"L6", "B23", "B25"}) {
    ProgramRun run(text, with_control(std::string("start_at = \"") + at + "\""));
    EXPECT_EQ(run.step(), StepState::Ended) << at << run.alarm();
    EXPECT_EQ(run.events("rapid").size(), 4U) << at << ": to Z.1 and X1, then N6 and X5";
  }
}

TEST(StartAt, LineBeyondTheTextBeginsAtTheFirstBlock) {
  ProgramRun run("G0 X1\nX2\n", with_control("start_at = \"L9\""));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("rapid").size(), 2U);
}

/// A start inside a called program is found in the order of execution, when the pass is named.
TEST(StartAt, BlockMayBeInACalledProgram) {
  ProgramRun run("O1\nG0 X1\nM98 P2\nX3\nM30\nO2\nX7\nN70 X2\n",
                 with_control("start_at = \"N70\"\nstart_pass = 1"));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("rapid").size(), 2U) << "N70, X3; to where O2 was by then it is a feed";
}

TEST(StartAt, AfterAProbeMoveIsAnAlarmBeforeAnythingMoves) {
  ProgramRun run("G98 F5\nPROBE1 G1 Z-1\nN9 X1\n", with_control("start_at = \"N9\""));
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN1011 2:0")) << run.alarm();
}

/// An answer decides the program's path, so the question is asked even during a search.
TEST(StartAt, InputsBeforeItAreAsked) {
  ProgramRun run("INPUT (N) P1\nP1=P1*2\nN9 PRINT[#1[10]]\n", with_control("start_at = \"N9\""));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(PromptAnswer{"4"}));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.printed(), std::vector<std::string>{"8"});
  EXPECT_TRUE(run.events("prompt").empty());
}

struct ModeCase {
  std::string name;
  std::string control;
  std::string text;
  std::string verdict;  ///< empty: it runs
};

class RunMode : public testing::TestWithParam<ModeCase> {};

/// CEN-203, CEN-207, CEN-223.
TEST_P(RunMode, RefusesWhatTheModeLacks) {
  ProgramRun run(GetParam().text, with_control(GetParam().control));
  if (GetParam().verdict.empty()) {
    EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
    return;
  }
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with(GetParam().verdict + " ")) << run.alarm();
}

INSTANTIATE_TEST_SUITE_P(
    , RunMode,
    testing::Values(
        ModeCase{"loop", "dnc_refusals = true", "WHILE P1<2\nP1=P1+1\nWEND\n", "CEN1008 1:1"},
        ModeCase{"gosub", "dnc_refusals = true", "GOSUB 5\nM30\nN5 RETURN\n", "CEN1008 1:1"},
        ModeCase{"call", "dnc_refusals = true", "CALL 5\n", "CEN1008 1:1"},
        ModeCase{"m98", "dnc_refusals = true", "M98 P5\n", "CEN1008 1:0"},
        ModeCase{"goto_is_resolved", "dnc_refusals = true", "GOTO 5\nX1\nN5 M30\n", ""},
        ModeCase{"goto_is_not_resolved", "dnc_refusals = true\nresolve_dnc = false",
                 "GOTO 5\nN5 M30\n", "CEN1008 1:1"},
        ModeCase{"ours_knows_no_limits", "resolve_dnc = false",
                 "GOTO 5\nN5 WHILE P1<2\nP1=P1+1\nWEND\n", ""},
        ModeCase{"fast_compensation", "dnc_mode = \"fast\"", "G41\n", "CEN1008 1:0"},
        ModeCase{"fast_scaling", "dnc_mode = \"fast\"", "G551 P2\n", "CEN1008 1:0"},
        ModeCase{"fast_units", "dnc_mode = \"fast\"", "G20\n", "CEN0609 1:0"},
        ModeCase{"mdi_call", "mode = \"mdi\"", "M98 P5\n", "CEN0518 1:0"},
        ModeCase{"mdi_second_block", "mode = \"mdi\"", "G0 X1\nX2\n", "CEN0518 2:0"},
        ModeCase{"mdi_empty_lines", "mode = \"mdi\"", "G0 X1\n\n\n", ""}),
    [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace dripline::interpreter::centurion
