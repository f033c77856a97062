#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Expressions of custom macro B: `#2*[#1+3]`, `ATAN[#1]/[#2]`. A null variable is a NaN (kNull):
/// it counts as 0 in arithmetic and differs from 0 only in EQ and NE.
namespace dripline::interpreter::fanuc {

/// Reads and evaluates the sum at `at` and moves `at` after it; null only when it is nothing but a
/// null variable.
bool read_expression(Run& run, const char*& at, double& value);
/// A condition in brackets.
bool read_condition(Run& run, const char*& at, bool& holds);
/// What may follow an address instead of a number: an optional sign, then a variable or an
/// expression in brackets. ROUND goes to `least`, the least increment of the address.
bool read_operand(Run& run, const char*& at, double least, double& value);
/// `#` and which one: the variable's number. `at` is on the #.
bool read_variable_number(Run& run, const char*& at, int& number);

}  // namespace dripline::interpreter::fanuc
