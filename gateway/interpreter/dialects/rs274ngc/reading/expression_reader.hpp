#pragma once

#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Real values (NIST 3.3): numbers, parameters, functions and expressions in brackets. Read and
/// computed in one pass over the text, with the parameters as they were before the line.

/// Numbers without parameters and expressions (NIST 3.3).

namespace dripline::interpreter::rs274ngc {

/// Reads one real value at `at`, which then moves after it.
bool read_value(Run& run, const char*& at, double& value);
/// One that must be within 0.0001 of a whole number.
bool read_integer(Run& run, const char*& at, int& value);
/// `[ ... ]`; `at` is on the bracket.
bool read_expression(Run& run, const char*& at, double& value);

/// Reads `<name>` at `at` (on the `<`), blanks removed, in small letters.
bool read_name(Run& run, const char*& at, std::string& name);

/// Whether `word` (capitals) is at `at`, blanks between its letters allowed; then `at` moves
/// after it.
bool take_word(const char*& at, const char* word);

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
