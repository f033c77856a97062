#pragma once

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

/// What the fast reader has refused: a number of many digits, or an error.
[[gnu::cold]] bool read_unusual_number(Run& run, const char*& at, NumberFault fault, double& value);

/// Any number at `at`, which then moves after it. Always inline: programs are numbers more than
/// anything, and a call costs as much as three digits.
[[gnu::always_inline]] inline bool read_number_at(Run& run, const char*& at, double& value) {
  constexpr NumberRules kRules{.skip_blanks = true};
  NumberText number;
  // the line's end is no character of a number, so that no end need be given
  const char* after = read_number<kRules>(at, nullptr, number);
  if (number.fault != NumberFault::None) [[unlikely]]
    return read_unusual_number(run, at, number.fault, value);
  value = number.value;
  at = after;
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
