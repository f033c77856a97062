#pragma once

#include "gateway/interpreter/dialects/rs274ngc/reading/number_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Real values (NIST 3.3): numbers, parameters, functions and expressions in brackets. Read and
/// computed in one pass over the text, with the parameters as they were before the line.

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

}  // namespace dripline::interpreter::rs274ngc
