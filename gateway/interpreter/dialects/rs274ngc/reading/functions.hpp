#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// The functions of expressions (NIST 3.3); angles in degrees.
namespace dripline::interpreter::rs274ngc {

enum class Function : std::uint8_t {
  Abs,
  Acos,
  Asin,
  Atan,
  Cos,
  Exp,
  Exists,
  Fix,
  Fup,
  Ln,
  Round,
  Sin,
  Sqrt,
  Tan,
  None,
};
/// The function named at `at`, which then moves after it; None leaves it.
Function take_function(const char*& at);

/// What the function of one argument gives, or the error it has.
bool compute(Run& run, Function function, std::uint32_t column, double& value);

}  // namespace dripline::interpreter::rs274ngc
