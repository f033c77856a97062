#pragma once

#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Numbers without parameters and expressions (NIST 3.3).
namespace dripline::interpreter::rs274ngc {

/// One to nine digits and nothing that continues them: most indexes, labels and constants.
inline bool take_small_number(const char*& at, double& value) {
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

/// Any number at `at`, which then moves after it.
bool read_number_at(Run& run, const char*& at, double& value);

}  // namespace dripline::interpreter::rs274ngc
