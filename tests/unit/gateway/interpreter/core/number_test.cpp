#include "gateway/interpreter/core/language/number.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace dripline::interpreter {
namespace {

template <NumberRules kRules = NumberRules{}>
NumberText read(std::string_view text, std::size_t* consumed = nullptr) {
  NumberText number;
  const char* after = read_number<kRules>(text.data(), text.data() + text.size(), number);
  if (consumed) *consumed = static_cast<std::size_t>(after - text.data());
  return number;
}

TEST(Number, KeepsWhatWasWritten) {
  const NumberText number = read("-012.340");
  EXPECT_EQ(number.fault, NumberFault::None);
  EXPECT_EQ(number.value, -12.34);
  EXPECT_EQ(number.leading, 3);
  EXPECT_EQ(number.trailing, 3);
  EXPECT_TRUE(number.has_point);
  EXPECT_TRUE(number.is_negative);
  EXPECT_FALSE(read("12").has_point);
  EXPECT_TRUE(read("12.").has_point);
  EXPECT_EQ(read(".5").value, 0.5);
  EXPECT_EQ(read("+7").value, 7);
  EXPECT_TRUE(std::signbit(read("-0").value));
}

TEST(Number, StopsAfterTheLastDigit) {
  std::size_t consumed = 0;
  EXPECT_EQ(read("1.5Z2", &consumed).value, 1.5);
  EXPECT_EQ(consumed, 3U);
  EXPECT_EQ(read("1E5", &consumed).value, 1);  // E is an address, never an exponent
  EXPECT_EQ(consumed, 1U);
  EXPECT_EQ(read("1 .5", &consumed).value, 1);
  EXPECT_EQ(consumed, 1U);
}

TEST(Number, BlanksAndCommasAreRulesOfADialect) {
  constexpr NumberRules kBlanks{true, false};
  constexpr NumberRules kComma{false, true};
  EXPECT_EQ(read<kBlanks>(" - 1 . 23 4").value, -1.234);
  EXPECT_EQ(read<kBlanks>("1 2 .").value, 12);
  EXPECT_EQ(read<kBlanks>("1. 2 . 3").fault, NumberFault::SecondPoint);
  std::size_t consumed = 0;
  EXPECT_EQ(read<kBlanks>("1.5  Z2", &consumed).value, 1.5);
  EXPECT_EQ(consumed, 5U) << "a number includes the blanks after it";
  EXPECT_EQ(read<kComma>("20,005").value, 20.005);
  EXPECT_EQ(read("20,005").value, 20);
}

TEST(Number, FaultsAreReported) {
  for (const char* text : {"", "-", "+.", ".", "X", "--1"}) {
    EXPECT_EQ(read(text).fault, NumberFault::NoDigits) << text;
  }
  EXPECT_EQ(read("1.2.3").fault, NumberFault::SecondPoint);
  EXPECT_EQ(read("1234567890123456789").fault, NumberFault::TooManyDigits);
  EXPECT_EQ(read("0.1234567890123456789").fault, NumberFault::TooManyDigits);
  EXPECT_EQ(read(std::string(1000, '9')).fault, NumberFault::TooManyDigits);
  EXPECT_EQ(read(std::string(1000, '0')).fault, NumberFault::TooManyDigits);
  EXPECT_EQ(read("000000000000000000000000012").value, 12) << "leading zeros are no digits";
}

RC_GTEST_PROP(Number, IsTheDoubleNearestToTheText, ()) {
  const auto digits = *rc::gen::inRange<std::uint64_t>(0, 999'999'999'999'999'999);
  const auto scale = *rc::gen::inRange<std::size_t>(0, 19);
  std::string text = std::to_string(digits);
  if (text.size() <= scale) text.insert(0, scale + 1 - text.size(), '0');
  text.insert(text.size() - scale, ".");
  double expected = 0;
  std::from_chars(text.data(), text.data() + text.size(), expected, std::chars_format::fixed);
  const NumberText number = read(text);
  RC_ASSERT(number.fault == NumberFault::None);
  RC_ASSERT(number.value == expected);
}

}  // namespace
}  // namespace dripline::interpreter
