#pragma once

#include <array>
#include <charconv>
#include <cstdint>

namespace dripline::interpreter {

/// How a control writes numbers. A template argument: a dialect pays only for what it allows.
struct NumberRules {
  bool skip_blanks = false;  ///< blanks within the number mean nothing (`X 1 . 23 4`)
  bool comma_point = false;  ///< a comma is a decimal point as well
};

enum class NumberFault : std::uint8_t {
  None,
  NoDigits,       ///< nothing, or only a sign or a point
  SecondPoint,    ///< `1.2.3`
  TooManyDigits,  ///< more than 18 significant digits
};

/// A number as it was written; `value` is the double nearest to it.
struct NumberText {
  double value = 0;
  std::uint8_t leading = 0;   ///< digits written before the point
  std::uint8_t trailing = 0;  ///< digits written after it
  bool has_point = false;
  bool has_sign = false;
  bool is_negative = false;  ///< a minus was written, even before zero
  NumberFault fault = NumberFault::None;
};

namespace number_detail {

inline constexpr std::array<double, 19> kPowerOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                                    1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                                    1e14, 1e15, 1e16, 1e17, 1e18};
inline constexpr int kMaxDigits = 18;
inline constexpr int kMaxWritten = 255;  // of leading and of trailing, zeros included

/// digits / 10^scale, correctly rounded: both are exact doubles up to 2^53 and 10^18, and one
/// division rounds once. Longer numbers take the slow and exact path.
[[gnu::noinline, gnu::cold]] inline double long_to_double(std::uint64_t digits, int scale) {
  std::array<char, 32> text;
  char* at = std::to_chars(text.data(), text.data() + 20, digits).ptr;
  *at++ = 'e';
  at = std::to_chars(at, text.data() + text.size(), -scale).ptr;
  double value = 0;
  std::from_chars(text.data(), at, value);
  return value;
}
inline double to_double(std::uint64_t digits, int scale) {
  if (digits > (std::uint64_t{1} << 53)) [[unlikely]]
    return long_to_double(digits, scale);
  return static_cast<double>(static_cast<std::int64_t>(digits)) /
         kPowerOfTen[static_cast<std::size_t>(scale)];
}

/// Numbers with blanks within, with too many digits or with a fault.
template <NumberRules kRules = NumberRules{}>
[[gnu::noinline]] const char* read_any_number(const char* at, const char* end, NumberText& number) {
  number = NumberText{};
  const auto skip = [&] {
    if constexpr (kRules.skip_blanks) {
      while (at != end && (*at == ' ' || *at == '\t')) ++at;
    }
  };
  skip();
  if (at != end && (*at == '-' || *at == '+')) {
    number.has_sign = true;
    number.is_negative = *at == '-';
    ++at;
  }
  std::uint64_t digits = 0;
  int significant = 0;
  int leading = 0;
  int trailing = 0;
  for (; at != end; ++at) {
    const auto digit = static_cast<unsigned>(static_cast<unsigned char>(*at)) - '0';
    if (digit <= 9) {
      if (digits != 0 || digit != 0) ++significant;
      if (significant <= kMaxDigits) digits = digits * 10 + digit;
      number.has_point ? ++trailing : ++leading;
      continue;
    }
    if (*at == '.' || (kRules.comma_point && *at == ',')) {
      if (number.has_point) {
        number.fault = NumberFault::SecondPoint;
        return at;
      }
      number.has_point = true;
      continue;
    }
    if constexpr (kRules.skip_blanks) {
      if (*at == ' ' || *at == '\t') continue;
    }
    break;
  }
  if (leading + trailing == 0) {
    number.fault = NumberFault::NoDigits;
    return at;
  }
  if (significant > kMaxDigits || trailing > kMaxDigits || leading > kMaxWritten) {
    number.fault = NumberFault::TooManyDigits;
    return at;
  }
  number.leading = static_cast<std::uint8_t>(leading);
  number.trailing = static_cast<std::uint8_t>(trailing);
  const double value = to_double(digits, trailing);
  number.value = number.is_negative ? -value : value;
  return at;
}

}  // namespace number_detail

/// Reads [+|-] digits [. digits] at `at` and returns the first character after it; the caller
/// looks at `number.fault`. No exponent, no locale. Leading zeros do not count as significant,
/// trailing ones do. Reads the usual number in one pass of two tight loops; always inlined, so that
/// what a caller does not ask for is not written.
template <NumberRules kRules = NumberRules{}>
[[gnu::always_inline]] inline const char* read_number(const char* begin, const char* end,
                                                      NumberText& number) {
  const auto is_digit = [&](const char* at) {
    return at != end && static_cast<unsigned char>(*at - '0') <= 9;
  };
  const auto is_point = [&](const char* at) {
    return at != end && (*at == '.' || (kRules.comma_point && *at == ','));
  };
  const char* at = begin;
  const bool has_sign = at != end && (*at == '-' || *at == '+');
  const bool is_negative = has_sign && *at == '-';
  if (has_sign) ++at;
  std::uint64_t digits = 0;
  const char* const leading_begin = at;
  for (; is_digit(at); ++at) digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
  const auto leading = at - leading_begin;
  const bool has_point = is_point(at);
  if (has_point) ++at;
  const char* const trailing_begin = at;
  if (has_point) {
    for (; is_digit(at); ++at) digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
  }
  const auto trailing = at - trailing_begin;
  if constexpr (kRules.skip_blanks) {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
  }
  const bool goes_on = is_point(at) || (kRules.skip_blanks && is_digit(at));
  const auto written = leading + trailing;
  if (goes_on || written == 0 || written > number_detail::kMaxDigits) [[unlikely]] {
    NumberText any;  // apart, so that the usual number can stay in registers
    at = number_detail::read_any_number<kRules>(begin, end, any);
    number = any;
    return at;
  }
  const double value = number_detail::to_double(digits, static_cast<int>(trailing));
  number = NumberText{is_negative ? -value : value,
                      static_cast<std::uint8_t>(leading),
                      static_cast<std::uint8_t>(trailing),
                      has_point,
                      has_sign,
                      is_negative,
                      NumberFault::None};
  return at;
}

}  // namespace dripline::interpreter
