#include "protocol/base/decimal.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

struct NumberCase {
  const char* name;
  const char* text;
  std::int64_t digits;
  int scale;
  bool has_point;
  const char* printed;
};

class ParseDecimal : public testing::TestWithParam<NumberCase> {};

TEST_P(ParseDecimal, KeepsWhatWasWritten) {
  const auto number = parse_decimal(GetParam().text);
  ASSERT_TRUE(number) << number.error().what;
  EXPECT_EQ(number->digits, GetParam().digits);
  EXPECT_EQ(number->scale, GetParam().scale);
  EXPECT_EQ(number->has_point, GetParam().has_point);
  EXPECT_EQ(number->text(), GetParam().printed);
}

INSTANTIATE_TEST_SUITE_P(
    , ParseDecimal,
    testing::Values(NumberCase{"integer_has_no_point", "10", 10, 0, false, "10"},
                    NumberCase{"trailing_point_kept", "10.", 10, 0, true, "10."},
                    NumberCase{"leading_point", ".5", 5, 1, true, "0.5"},
                    NumberCase{"trailing_zeros_kept", "-1.50", -150, 2, true, "-1.50"},
                    NumberCase{"negative_zero", "-0.0", 0, 1, true, "-0.0"},
                    NumberCase{"plus_is_dropped", "+7", 7, 0, false, "7"},
                    NumberCase{"eighteen_digits", "123456789012345678", 123456789012345678, 0,
                               false, "123456789012345678"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(ParseDecimalErrors, RefusesWhatIsNotAPlainNumber) {
  for (const char* text : {"", "-", ".", "1.2.3", "1e5", "inf", "nan", " 1", "1 ", "0x10"}) {
    const auto number = parse_decimal(text);
    ASSERT_FALSE(number) << text;
    EXPECT_EQ(number.error().code, Errc::Syntax) << text;
  }
}

TEST(ParseDecimalErrors, RefusesMoreDigitsThanItCanHold) {
  EXPECT_EQ(parse_decimal("1234567890123456789").error().code, Errc::LimitExceeded);
  EXPECT_EQ(parse_decimal("0.0000000000000000001").error().code, Errc::LimitExceeded);
}

TEST(DecimalText, HasNoZerosAtItsEndAndNoMinusBeforeNothing) {
  EXPECT_EQ(decimal_text(1.25, 4), "1.25");
  EXPECT_EQ(decimal_text(-0.33333, 3), "-0.333");
  EXPECT_EQ(decimal_text(100, 3), "100");
  EXPECT_EQ(decimal_text(100, 0), "100");
  EXPECT_EQ(decimal_text(-0.00004, 4), "0");
  EXPECT_EQ(decimal_text(-0.4, 0), "0");
}

}  // namespace
}  // namespace dripline
