#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Numbers without parameters and expressions (NIST 3.3).
namespace dripline::interpreter::rs274ngc {

/// One to nine digits and nothing that continues them: most indexes, labels and constants.
inline bool take_small_number(const char*& at, int& value) {
  const char* s = at;
  int number = 0;
  for (; is_digit(*s); ++s) {
    if (s - at == 9) return false;
    number = number * 10 + (*s - '0');
  }
  if (s == at) return false;
  if (is_blank(*s)) s = skip_blanks(s);
  if (*s == '.' || is_digit(*s)) return false;
  at = s;
  value = number;
  return true;
}

inline constexpr std::array<double, 16> kPowersOfTen{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Most numbers of a program: at most 15 digits, with or without a point, blanks only after them.
/// What follows the blanks; nullptr for any other text, errors included.
[[gnu::always_inline]] inline const char* take_plain_number(const char* at, double& value) {
  constexpr unsigned kMaxDigits = 15;
  const bool is_negative = *at == '-';
  if (is_negative) ++at;
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const first = at;
    for (unsigned digit = 0; (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) <= 9; ++at)
      digits = digits * 10 + digit;
    return static_cast<unsigned>(at - first);
  };
  unsigned written = take_digits();
  unsigned scale = 0;
  if (*at == '.') [[likely]] {
    ++at;
    scale = take_digits();
    written += scale;
  }
  at = skip_blanks(at);
  if (written - 1 >= kMaxDigits || *at == '.' || is_digit(*at)) [[unlikely]]
    return nullptr;
  // Both are exact, so that the division rounds once.
  value = static_cast<double>(static_cast<std::int64_t>(digits)) / kPowersOfTen[scale];
  if (is_negative) value = -value;
  return at;
}

/// Any other number: one of many digits, with blanks within or a plus, or an error.
[[gnu::cold]] bool read_unusual_number(Run& run, const char*& at, double& value);

/// Any number at `at`, which then moves after it. Always inline: programs are numbers more than
/// anything, and a call costs as much as three digits.
[[gnu::always_inline]] inline bool read_number_at(Run& run, const char*& at, double& value) {
  const char* after = take_plain_number(at, value);
  if (after == nullptr) [[unlikely]]
    return read_unusual_number(run, at, value);
  at = after;
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
