#include "gateway/interpreter/dialects/centurion/reading/number.hpp"

#include <gtest/gtest.h>
#include <string>

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

}  // namespace
}  // namespace dripline::interpreter::centurion
