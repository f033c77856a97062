#include "gateway/interpreter/dialects/centurion/flow/output_text.hpp"

#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

namespace dripline::interpreter::centurion {
namespace {

struct FormatCase {
  std::string name;
  double value;
  int leading;
  int decimals;
  std::string text;
};

class AppendNumber : public testing::TestWithParam<FormatCase> {};

TEST_P(AppendNumber, PrintsAsTheControl) {
  std::string text;
  append_number(text, GetParam().value, GetParam().leading, GetParam().decimals);
  EXPECT_EQ(text, GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(, AppendNumber,
                         testing::Values(FormatCase{"as_needed", 32.45, 0, 4, "32.4500"},
                                         FormatCase{"padded", 2.87656, 3, 3, "002.877"},
                                         FormatCase{"negative", -0.1214, 0, 4, "-0.1214"},
                                         FormatCase{"sign_before_padding", -12.5, 3, 3, "-012.500"},
                                         FormatCase{"no_negative_zero", -0.00001, 0, 4, "0.0000"},
                                         FormatCase{"half_up", 0.125, 0, 2, "0.13"},
                                         FormatCase{"half_as_written", 1.0005, 0, 3, "1.001"},
                                         FormatCase{"half_away", -0.125, 0, 2, "-0.13"},
                                         FormatCase{"carry", 9.99999, 0, 4, "10.0000"},
                                         FormatCase{"wider_than_asked", 1234.5, 2, 1, "1234.5"},
                                         FormatCase{"no_decimals", 7.6, 2, 0, "08"},
                                         FormatCase{"nine_decimals", 0.1, 0, 9, "0.100000000"},
                                         FormatCase{"large", 1e15, 0, 4, "1000000000000000.0000"}),
                         [](const auto& i) { return i.param.name; });

TEST(PrintedText, SwallowsOneBlankAfterABareParameterOnly) {
  ProgramRun run("P3=1\nPRINT[X#3 Z#3  W#3[11] U]\n");
  run.step();
  EXPECT_EQ(run.printed(), std::vector<std::string>{"X1.0000Z1.0000 W1.0 U"});
}

TEST(PrintedText, MetricHasThreeDecimals) {
  ProgramRun run("G21\nP3=1.23456\nPRINT[#3]\n");
  run.step();
  EXPECT_EQ(run.printed(), std::vector<std::string>{"1.235"});
}

TEST(PrintedText, FaultsHaveTheirNumbers) {
  const std::pair<const char*, const char*> cases[] = {
      {"PRINT TEXT]\n", "CEN0553"},    {"PRINT[TEXT\n", "CEN0552"},
      {"PRINT[#500]\n", "CEN0517"},    {"PRINT[#]\n", "CEN0550"},
      {"PRINT[#1[]]\n", "CEN0550"},    {"PRINT[#1[-3]]\n", "CEN0550"},
      {"PRINT[#1[123]]\n", "CEN0550"}, {"PRINT[#1[24]\n", "CEN0552"},
      {"PRINT[\x01]\n", "CEN1003"},    {"PRINT[#1[00]]\n", "CEN0517"},
      {"DPRNT[X]\n", "CEN0103"},       {"POPEN P3\n", "CEN0517"}};
  for (const auto& [text, id] : cases) {
    ProgramRun run(text);
    EXPECT_EQ(run.step(), StepState::Alarmed) << text;
    EXPECT_TRUE(run.alarm().starts_with(id)) << text << run.alarm();
  }
}

TEST(Report, IsClosedAtTheEndOfTheProgram) {
  ProgramRun run("POPEN P2\nDPRNT[A]\nM30\n");
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("close").size(), 1U);
}

}  // namespace
}  // namespace dripline::interpreter::centurion
