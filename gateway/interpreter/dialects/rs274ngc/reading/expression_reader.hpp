#pragma once

#include "gateway/interpreter/dialects/rs274ngc/reading/number_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Real values (NIST 3.3): numbers, parameters, functions and expressions in brackets. Read and
/// computed in one pass over the text, with the parameters as they were before the line.

namespace dripline::interpreter::rs274ngc {

/// One real value that is no plain number, or one with blanks after its sign.
bool read_computed_value(Run& run, const char*& at, double& value);

/// Reads one real value at `at`, which then moves after it.
inline bool read_value(Run& run, const char*& at, double& value) {
  at = skip_blanks(at);
  const char* digits = *at == '-' || *at == '+' ? at + 1 : at;
  if (is_digit(*digits) || *digits == '.') [[likely]]
    return read_number_at(run, at, value);
  return read_computed_value(run, at, value);
}
/// One that must be within 0.0001 of a whole number.
bool read_integer(Run& run, const char*& at, int& value);
/// `[ ... ]`; `at` is on the bracket.
bool read_expression(Run& run, const char*& at, double& value);

/// Reads `<name>` at `at` (on the `<`), blanks removed, in small letters.
bool read_name(Run& run, const char*& at, std::string& name);

/// Whether `word` (capitals) is at `at`, blanks between its letters allowed; then `at` moves
/// after it.
inline bool take_word(const char*& at, const char* word) {
  const char* s = at;
  for (const char* w = word; *w != '\0'; ++w, ++s) {
    if (upper(*s) == *w) continue;
    if (w == word) return false;
    s = skip_blanks(s);
    if (upper(*s) != *w) return false;
  }
  at = s;
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
