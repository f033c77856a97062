#pragma once

#include <cstdint>

#include "gateway/interpreter/core/language/expression.hpp"

namespace dripline::interpreter::language {

/// The functions of one argument that the dialects with parameters know, each its own selection.
enum class Function : std::uint8_t {
  None,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Sqrt,
  Abs,
  Int,
  Rnd,
  Ln,
  Exp,
  Round,
  Fix,
  Fup,
  Bin,
  Bcd,
  Pin,
};

/// The functions that mean the same on all controls; a dialect computes the others itself
/// (Undefined).
inline Computed compute(Function function, double argument) {
  switch (function) {
    case Function::Sin:
      return sine(argument);
    case Function::Cos:
      return cosine(argument);
    case Function::Tan:
      return tangent(argument);
    case Function::Sqrt:
      return square_root(argument);
    case Function::Abs:
      return absolute(argument);
    case Function::Int:
      return integer_part(argument);
    case Function::Ln:
      return natural_logarithm(argument);
    case Function::Exp:
      return exponential(argument);
    case Function::Round:
      return rounded(argument);
    default:
      return {0, MathFault::Undefined};
  }
}

}  // namespace dripline::interpreter::language
