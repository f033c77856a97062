#include "clients/tools/tnc_conversion/value_text.hpp"

#include <array>
#include <charconv>

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

/// `places` digits of a fraction, the last ones left out as far as they are zeros and may be.
void add_fraction(std::string& text, std::int64_t fraction, int places, int needed, char sign) {
  std::array<char, 8> digits{};
  for (int i = places; i-- > 0; fraction /= 10) {
    digits[static_cast<std::size_t>(i)] = static_cast<char>('0' + fraction % 10);
  }
  int count = places;
  while (count > needed && digits[static_cast<std::size_t>(count) - 1] == '0') --count;
  if (count == 0) return;
  text += sign;
  text.append(digits.data(), static_cast<std::size_t>(count));
}

}  // namespace

void add_integer(std::string& text, std::int64_t number, int width) {
  std::array<char, 24> digits{};
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  for (auto missing = width - (end - digits.data()); missing > 0; --missing) text += '0';
  text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

void add_millionths(std::string& text, std::int32_t number, char decimal_sign, bool has_all) {
  add_integer(text, number / 1'000'000);
  add_fraction(text, number % 1'000'000, 6, has_all ? 6 : 0, decimal_sign);
}

void ValueText::add(std::string& text, const Value& value, Sign sign) const {
  if (value.is_q()) {
    text += value.is_negated ? "-Q" : "+Q";
    return add_integer(text, value.number);
  }
  const std::int64_t steps = value.number < 0 ? -std::int64_t{value.number} : value.number;
  if (value.number < 0) text += '-';
  if (value.number >= 0 && sign == Sign::Always) text += '+';
  add_integer(text, steps / Value::kStepsPerUnit);
  // More decimals than usual are never lost.
  add_fraction(text, steps % Value::kStepsPerUnit, 4, decimals == kAsNeeded ? 0 : decimals,
               decimal_sign);
}

}  // namespace dripline::tnc_conversion
