#include <fmt/core.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/errors.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// Waits for inputs, called programs and the list of errors, where a trace cannot show them.
namespace dripline::interpreter::centurion {
namespace {

using ControlSetup = interpreter::Setup;  // gtest keeps a private member named Setup

ControlSetup with_control(const std::string& options) {
  auto setup = parse_setup("[control]\n" + options, Units::Inch);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

/// CEN-145, CEN-148.
TEST(InputWaits, AskForThePinAndDoNothingTwice) {
  ProgramRun run("S400 M3 M20 M63 G1 G98 F5 Z-1 M9\n", with_control("ask_inputs = true"));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  const auto question = std::get<InputQuestion>(run.interpreter().question());
  EXPECT_EQ(question.pin, 2000);
  EXPECT_TRUE(run.events("line").empty()) << "the move comes after the wait";
  ASSERT_TRUE(run.interpreter().answer(true));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("spindle").size(), 1U);
  EXPECT_EQ(run.events("misc"), (std::vector<std::string>{"20", "63"}));
  EXPECT_EQ(run.events("line").size(), 1U);
  EXPECT_EQ(run.events("coolant").size(), 1U);
}

TEST(InputWaits, TwoInOneBlockAskInOrderAndAProbeMoveGetsItsOwnAnswer) {
  ProgramRun run("M32 M81 PROBE1 G1 G98 F5 Z-1\n", with_control("ask_inputs = true"));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 1005);
  ASSERT_TRUE(run.interpreter().answer(true));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 2001);
  ASSERT_TRUE(run.interpreter().answer(true));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  EXPECT_TRUE(std::holds_alternative<ProbeQuestion>(run.interpreter().question()));
  ASSERT_TRUE(run.interpreter().answer(ProbeResult{}));
  EXPECT_EQ(run.step(), StepState::Ended);
}

TEST(InputWaits, AnInputThatNeverComesIsAnAlarm) {
  ProgramRun run("M85\n", with_control("ask_inputs = true"));
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(false));
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN1010 1:0")) << run.alarm();
}

/// CEN-161.
TEST(CalledPrograms, NestFiftyLevelsDeepAtMost) {
  ProgramRun run("P1=0\nG65 P7 A1\nM30\nO7\nP2=P2+1\nIF P2<50 G65 P7\n");
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  ProgramRun is_too_deep("G65 P7\nM30\nO7\nG65 P7\n");
  EXPECT_EQ(is_too_deep.step(), StepState::Alarmed);
  EXPECT_TRUE(is_too_deep.alarm().starts_with("CEN0546 ")) << is_too_deep.alarm();
}

struct CallCase {
  std::string name;
  std::string control;
  std::string text;
  std::string verdict;
};

class CallRefusal : public testing::TestWithParam<CallCase> {};

/// CEN-157, CEN-158, CEN-159, CEN-162.
TEST_P(CallRefusal, NamesTheErrorAndThePlace) {
  ProgramRun run(GetParam().text, with_control(GetParam().control));
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with(GetParam().verdict + " ")) << run.alarm();
}

INSTANTIATE_TEST_SUITE_P(
    , CallRefusal,
    testing::Values(CallCase{"no_such_macro", "", "G65 P55 A1\n", "CEN0603 1:0"},
                    CallCase{"macro_number", "", "G65 P10000\n", "CEN0301 1:5"},
                    CallCase{"macro_and_jump", "", "G65 P5 GOTO 1\nN1\n", "CEN0518 1:5"},
                    CallCase{"macro_and_end", "", "G65 P5 M30\n", "CEN0518 1:0"},
                    CallCase{"macro_and_cycle", "", "G65 P5 G81\n", "CEN0518 1:8"},
                    CallCase{"two_custom_codes", "custom_m = [50, 51]", "M50 M51\n", "CEN0518 1:5"},
                    CallCase{"custom_g_missing", "custom_g = [107]", "G107\n", "CEN0603 1:0"},
                    CallCase{"not_bound", "custom_g = [107]", "G108\n", "CEN0549 1:1"},
                    CallCase{"tool_macro_missing", "m6_macro = 9100", "T1 M6\n", "CEN0603 1:0"},
                    CallCase{"tool_macro_and_call", "m6_macro = 9100", "M6 M98 P5\n",
                             "CEN0518 1:0"},
                    CallCase{"macro_in_dnc", "dnc_refusals = true", "G65 P5\n", "CEN1008 1:5"},
                    CallCase{"custom_code_in_dnc", "dnc_refusals = true\ncustom_m = [50]", "M50\n",
                             "CEN1008 1:1"},
                    CallCase{"pin_that_is_none", "", "P1=PIN[1500]\n", "CEN0517 1:13"}),
    [](const auto& i) { return i.param.name; });

struct OptionCase {
  std::string name;
  std::string control;
};

class OptionRefusal : public testing::TestWithParam<OptionCase> {};

TEST_P(OptionRefusal, NamesTheOption) {
  MemorySource source("X1\n");
  EventSink sink;
  const auto made = kCenturionDialect.make(with_control(GetParam().control), source, sink);
  ASSERT_FALSE(made);
  const std::string option = GetParam().control.substr(0, GetParam().control.find(' '));
  EXPECT_NE(made.error().what.find(option), std::string::npos) << made.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , OptionRefusal,
    testing::Values(OptionCase{"eleven_codes", "custom_g = [1,2,3,4,5,6,7,8,9,10,11]"},
                    OptionCase{"m_above_99", "custom_m = [100]"},
                    OptionCase{"negative_code", "post_m = [-1]"},
                    OptionCase{"program_above_9999", "m6_macro = 10000"},
                    OptionCase{"spindle_check", "cycle_spindle = \"stop\""},
                    OptionCase{"ramp", "tap_ramp = -1"}, OptionCase{"mode", "mode = \"dry\""}),
    [](const auto& i) { return i.param.name; });

/// CEN-229.
TEST(ErrorList, HasTheNumbersOfTheControlUnderTheirIds) {
  for (int number = 1; number < 1000; ++number) {
    const ErrorRow& row = error_row_of_number(number);
    if (row.code == ErrorCode::ForcedError) continue;
    EXPECT_EQ(static_cast<int>(row.code), number);
    EXPECT_EQ(row.id, fmt::format("CEN{:04}", number));
    EXPECT_FALSE(row.text.empty());
  }
  for (const int number : {1,   18,  100, 163, 214, 316, 319, 400, 406, 412, 418,
                           451, 457, 500, 542, 569, 587, 599, 609, 903, 952}) {
    EXPECT_EQ(static_cast<int>(error_row_of_number(number).code), number);
  }
  for (const int number : {14, 99, 317, 414, 510, 604, 999, 1001}) {
    EXPECT_EQ(error_row_of_number(number).code, ErrorCode::ForcedError);
  }
}

/// CEN-177, CEN-229: G997 raises any of them, by its own number and text.
TEST(ErrorList, IsWhatG997Raises) {
  ProgramRun run("P1=451\nG997\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN0451 2:0")) << run.alarm();
}

}  // namespace
}  // namespace dripline::interpreter::centurion
