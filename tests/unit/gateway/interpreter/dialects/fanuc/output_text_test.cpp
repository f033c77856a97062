#include "gateway/interpreter/dialects/fanuc/execution/output_text.hpp"

#include <gtest/gtest.h>

/// How DPRNT and BPRNT print a value.
namespace dripline::interpreter::fanuc {
namespace {

struct FieldCase {
  const char* name;
  double value;
  DecimalField field;
  const char* text;
};

class DecimalOutput : public testing::TestWithParam<FieldCase> {};

TEST_P(DecimalOutput, PrintsAsTheFieldSays) {
  std::string text;
  append_decimal(text, GetParam().value, GetParam().field);
  EXPECT_EQ(text, GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    , DecimalOutput,
    testing::Values(FieldCase{"blanks_stand_for_zeros", 7.25, {4, 2, true, false}, "    7.25"},
                    FieldCase{"sign_before_the_blanks", -7.25, {4, 2, true, false}, "-   7.25"},
                    FieldCase{"half_away_from_zero", 0.125, {1, 2, true, false}, " 0.13"},
                    FieldCase{"decimal_half_is_a_half", 1.005, {1, 2, false, false}, "1.01"},
                    FieldCase{"left_digits_are_lost", 98765.4, {2, 1, true, false}, " 65.4"},
                    FieldCase{"lost_digits_leave_zeros", 9003, {3, 0, true, false}, "   3"},
                    FieldCase{
                        "rounding_to_zero_loses_the_sign", -0.004, {1, 2, false, false}, "0.00"},
                    FieldCase{"zeros_suppressed", 42, {6, 0, false, false}, "42"},
                    FieldCase{"no_whole_digits", 0.5, {0, 3, false, false}, ".500"},
                    FieldCase{"expanding", 98765.4, {2, 1, false, true}, "98765.4"},
                    FieldCase{"huge", 1e40, {3, 0, false, false}, "0"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(BinaryOutput, IsThirtyTwoBitsHighByteFirst) {
  std::string text;
  append_binary(text, 1.5, 1);
  append_binary(text, -2, 0);
  EXPECT_EQ(text, "\\x00\\x00\\x00\\x0F\\xFF\\xFF\\xFF\\xFE");
}

TEST(BinaryOutput, KeepsTheLowBitsOfWhatIsTooLarge) {
  std::string text;
  append_binary(text, 4294967296.0 + 5, 0);
  append_binary(text, 1e40, 9);
  EXPECT_EQ(text.substr(0, 16), "\\x00\\x00\\x00\\x05");
  EXPECT_EQ(text.size(), 32U);
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
