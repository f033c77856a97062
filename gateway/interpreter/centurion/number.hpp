#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/centurion/characters.hpp"

/// Numbers as this control reads them: calculator format, a whole number means whole units, blanks
/// may stand anywhere, also between digits (spec 3.1, 3.4).
namespace dripline::interpreter::centurion {

enum class NumberFault : std::uint8_t { None, Missing, TooManyDigits, TwoPoints };

struct Number {
  double value = 0;
  std::uint8_t digits = 0;  ///< as written, leading zeros included
  bool has_point = false;
  NumberFault fault = NumberFault::None;
};

inline constexpr unsigned kMostDigits = 18;  ///< what the mantissa below holds
inline constexpr std::array<double, kMostDigits + 1> kPowersOfTen{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
    1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

/// Reads the number at `at` and leaves `at` behind its last character. The text must end with an
/// end-of-block character.
inline Number read_number(const char*& at) {
  const char* s = at;
  const bool negative = *s == '-';
  if (negative || *s == '+') s = skip_blanks(s + 1);
  std::uint64_t mantissa = 0;
  unsigned digits = 0;
  unsigned decimals = 0;
  bool has_point = false;
  NumberFault fault = NumberFault::None;
  for (;;) {
    const auto digit = static_cast<unsigned char>(*s - '0');
    if (digit < 10) {
      mantissa = mantissa * 10 + digit;
      ++digits;
      decimals += has_point;
      ++s;
    } else if (*s == '.') {
      if (has_point) fault = NumberFault::TwoPoints;
      has_point = true;
      ++s;
    } else if (is_blank(*s)) {
      const char* next = skip_blanks(s);
      if (!is_digit(*next) && *next != '.') break;
      s = next;
    } else {
      break;
    }
  }
  at = s;
  if (digits == 0) return {0, 0, has_point, NumberFault::Missing};
  if (digits > kMostDigits) return {0, 255, has_point, NumberFault::TooManyDigits};
  const double value =
      static_cast<double>(static_cast<std::int64_t>(mantissa)) / kPowersOfTen[decimals];
  return {negative ? -value : value, static_cast<std::uint8_t>(digits), has_point, fault};
}

}  // namespace dripline::interpreter::centurion
