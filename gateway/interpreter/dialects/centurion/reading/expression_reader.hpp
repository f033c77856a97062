#pragma once

#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Expressions of parameters (manual: expressions): `P2*[P1+3]`, `ATAN[P1/P2]`, `PIN[1000]`.
namespace dripline::interpreter::centurion {

/// Reads and evaluates the sum at `at` (no comparison) and moves `at` after it.
bool read_expression(Run& run, const char*& at, double& value);
/// A condition: two sums with one comparison between them.
bool read_condition(Run& run, const char*& at, bool& holds);
/// The value of a word: a number, or an expression in brackets. `digits` of an expression is 0.
bool read_word_value(Run& run, const char*& at, double& value, unsigned& digits);
/// A whole number from 0 up to `limit`, or an expression in brackets; else error 517.
bool read_whole(Run& run, const char*& at, double limit, std::uint32_t& value);
/// Blanks and comments.
bool skip_gaps(Run& run, const char*& at);

bool read_parameter(Run& run, double number, std::uint32_t column, double& value);
/// `number` as a parameter number, checked to be whole and in range; else error 517.
bool check_parameter_number(Run& run, double number, int count, std::uint32_t column);

}  // namespace dripline::interpreter::centurion
