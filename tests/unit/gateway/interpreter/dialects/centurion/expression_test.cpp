#include <string>

#include <gtest/gtest.h>

#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

namespace dripline::interpreter::centurion {

namespace {

struct NumberCase {
  std::string name;
  std::string text;
  double value;
  unsigned digits;
  std::size_t length;  ///< of what is read
  NumberFault fault = NumberFault::None;
};

class ReadNumber : public testing::TestWithParam<NumberCase> {};

TEST_P(ReadNumber, ReadsToTheEndOfTheNumber) {
  const std::string text = GetParam().text + "\n";
  const char* at = text.data();
  const Number number = read_number(at);
  EXPECT_EQ(number.fault, GetParam().fault);
  EXPECT_EQ(at - text.data(), static_cast<std::ptrdiff_t>(GetParam().length));
  if (number.fault != NumberFault::None) return;
  EXPECT_EQ(number.value, GetParam().value);
  EXPECT_EQ(digits_of(number), GetParam().digits);
}

INSTANTIATE_TEST_SUITE_P(
    , ReadNumber,
    testing::Values(NumberCase{"whole", "15", 15, 2, 2}, NumberCase{"point_after", "15.", 15, 2, 3},
                    NumberCase{"point_first", ".5X", 0.5, 1, 2},
                    NumberCase{"minus", "-12.3456", -12.3456, 6, 8},
                    NumberCase{"plus", "+1.5", 1.5, 2, 4},
                    NumberCase{"blanks_inside", "1 . 23 4", 1.234, 4, 8},
                    NumberCase{"blanks_after", "12  X3", 12, 2, 4},
                    NumberCase{"blank_after_sign", "- 4", -4, 1, 3},
                    NumberCase{"leading_zeros_are_digits", "0101", 101, 4, 4},
                    NumberCase{"tenth_is_nearest", "0.1", 0.1, 2, 3},
                    NumberCase{"nothing", "X", 0, 0, 0, NumberFault::NoDigits},
                    NumberCase{"only_a_point", ".", 0, 0, 1, NumberFault::NoDigits},
                    NumberCase{"two_points", "1.2.3", 0, 3, 3, NumberFault::SecondPoint},
                    NumberCase{"eighteen_digits", "123456789012345678", 123456789012345678.0, 18,
                               18},
                    NumberCase{"nineteen_digits", "1234567890123456789", 0, 19, 19,
                               NumberFault::TooManyDigits}),
    [](const auto& i) { return i.param.name; });

struct ExpressionCase {
  std::string name;
  std::string text;
  std::string printed;  ///< with four decimals, or the alarm's id
};

class Expression : public testing::TestWithParam<ExpressionCase> {};

TEST_P(Expression, HasTheValueOfTheManual) {
  ProgramRun run("P2=3 P4=4 PB7=200\nP1=" + GetParam().text + "\nPRINT[#1]\n");
  run.step();
  const std::string result =
      run.alarm().empty() ? run.printed().at(0) : run.alarm().substr(0, run.alarm().find(' '));
  EXPECT_EQ(result, GetParam().printed) << run.alarm();
}

INSTANTIATE_TEST_SUITE_P(
    , Expression,
    testing::Values(ExpressionCase{"product_before_sum", "2+3*4", "14.0000"},
                    ExpressionCase{"power_before_product", "2*3**2", "18.0000"},
                    ExpressionCase{"left_to_right", "10-4-3", "3.0000"},
                    ExpressionCase{"powers_left_to_right", "2**3**2", "64.0000"},
                    ExpressionCase{"sign_before_power", "[-2]+1", "-1.0000"},
                    ExpressionCase{"minus_twice", "2--3", "5.0000"},
                    ExpressionCase{"brackets", "[2+3]*4", "20.0000"},
                    ExpressionCase{"parameters", "P2*P4", "12.0000"},
                    ExpressionCase{"byte_parameter", "PB7/2", "100.0000"},
                    ExpressionCase{"div_drops_the_fraction", "-7.5DIV2", "-3.0000"},
                    ExpressionCase{"mod_of_decimals", "7.5MOD2", "1.5000"},
                    ExpressionCase{"no_blanks_needed", "P4MODP2", "1.0000"},
                    ExpressionCase{"blanks_everywhere", "S Q R T [ 1 6 ]", "4.0000"},
                    ExpressionCase{"comment_inside", "1+(ONE) 2", "3.0000"},
                    ExpressionCase{"sine_is_exact", "SIN[180]", "0.0000"},
                    ExpressionCase{"cosine_of_sixty", "COS[60]", "0.5000"},
                    ExpressionCase{"angle_with_quadrant", "ATAN[1/-1]", "135.0000"},
                    ExpressionCase{"angle_signed_numerator", "ATAN[-5/5]", "-45.0000"},
                    ExpressionCase{"angle_of_products", "ATAN[P2*2/[P2+P2]]", "45.0000"},
                    ExpressionCase{"angle_straight_down", "ATAN[-1/0]", "-90.0000"},
                    ExpressionCase{"angle_along_minus", "ATAN[0/-1]", "180.0000"},
                    ExpressionCase{"rounding_halves_away", "ROUND[-1.5]", "-2.0000"},
                    ExpressionCase{"integer_part", "INT[-5.5]", "-5.0000"},
                    ExpressionCase{"division_by_zero", "1/0", "CEN0200"},
                    ExpressionCase{"mod_by_zero", "1 MOD 0", "CEN0200"},
                    ExpressionCase{"overflow", "EXP[1000]", "CEN0205"},
                    ExpressionCase{"angle_of_nothing", "ATAN[0/0]", "CEN0207"},
                    ExpressionCase{"no_close", "[1+2", "CEN0552"},
                    ExpressionCase{"no_open", "SIN 30", "CEN0553"},
                    ExpressionCase{"tangent_of_ninety", "TAN[90]", "CEN0554"},
                    ExpressionCase{"angle_without_slash", "ATAN[1]", "CEN0555"},
                    ExpressionCase{"root_of_negative", "SQRT[-1]", "CEN0556"},
                    ExpressionCase{"unknown_function", "SEC[1]", "CEN0557"},
                    ExpressionCase{"logarithm_of_zero", "LN[0]", "CEN0580"},
                    ExpressionCase{"power_of_zero", "0**2", "CEN0581"},
                    ExpressionCase{"power_of_negative", "-2**2", "CEN0581"},
                    ExpressionCase{"parameter_too_high", "P1000", "CEN0517"},
                    ExpressionCase{"parameter_not_whole", "P1.5", "CEN0517"},
                    ExpressionCase{"nothing", "", "CEN0550"}),
    [](const auto& i) { return i.param.name; });

TEST(Conditions, EqualWithinTheNinthDecimal) {
  ProgramRun run("P1=.1+.2\nIF P1=.3 PRINT[EQUAL]\nIF P1>.3 PRINT[NEVER]\nIF P1>=.3 PRINT[GE]\n");
  run.step();
  EXPECT_EQ(run.printed(), (std::vector<std::string>{"EQUAL", "GE"}));
}

TEST(Conditions, NeedARelation) {
  ProgramRun run("IF P1 THEN X1\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN0560 1:7")) << run.alarm();
}

TEST(Random, IsTheSameInEveryRunAndBelowItsLimit) {
  const std::string text =
      "N1 P1=RND[10]\nIF P1>9 PRINT[TOO BIG]\nPRINT[#1]\nP2=P2+1\nIF P2<50 GOTO 1\n";
  ProgramRun first(text);
  ProgramRun second(text);
  first.step();
  second.step();
  EXPECT_EQ(first.printed().size(), 50U);
  EXPECT_EQ(first.printed(), second.printed());
}

}  // namespace

}  // namespace dripline::interpreter::centurion
