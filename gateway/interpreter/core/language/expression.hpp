#pragma once

#include <cstdint>
#include <string_view>

/// Arithmetic that the dialects with parameters share: operators with their ranks, functions in
/// degrees, and the walk over an expression by rank. What an operand or an operator looks like in
/// the text is each dialect's own. Pure; any thread.
namespace dripline::interpreter::language {

/// Why a value could not be computed; a dialect gives each its control's own number.
enum class MathFault : std::uint8_t {
  None,
  DivisionByZero,
  NegativeRoot,
  LogArgument,
  PowerBase,  ///< zero or negative
  Tangent,    ///< of 90 degrees and its like
  Overflow,
  Undefined,  ///< e.g. the angle of 0/0
};
std::string_view to_string(MathFault fault);

struct Computed {
  double value = 0;
  MathFault fault = MathFault::None;
};

enum class Operator : std::uint8_t {
  None,
  Power,
  Multiply,
  Divide,
  IntegerDivide,  ///< quotient with its fraction dropped
  Modulo,         ///< a - b * trunc(a / b)
  Add,
  Subtract,
  Equal,
  NotEqual,
  Less,
  LessOrEqual,
  Greater,
  GreaterOrEqual,
  And,  ///< of truth: 0 is false, anything else is true, the result is 1 or 0
  Or,
  ExclusiveOr,
};

/// 4 power, 3 products, 2 sums, 1 comparisons and And, Or, ExclusiveOr, 0 none. All of one rank go
/// from left to right.
int rank(Operator op);
inline bool is_comparison(Operator op) {
  return op >= Operator::Equal && op <= Operator::GreaterOrEqual;
}

/// Comparisons give 1 or 0; reals count as equal when they differ by at most kEqualWithin.
Computed apply(Operator op, double left, double right);
inline constexpr double kEqualWithin = 1e-9;

Computed sine(double degrees);
Computed cosine(double degrees);
Computed tangent(double degrees);
/// Angle of the point (x, y) in (-180, 180].
Computed arc_tangent(double y, double x);
Computed square_root(double value);
Computed natural_logarithm(double value);
Computed exponential(double value);
Computed absolute(double value);
Computed integer_part(double value);  ///< toward zero
Computed rounded(double value);       ///< halves away from zero

/// Walks an expression by rank. `Terms` supplies:
///   bool operand(double& value);        one operand, with its signs, brackets and functions
///   Operator peek();                    the operator that follows, None at the end
///   void take();                        consumes it
///   bool fault(MathFault fault);        reports, gives false
/// and, where a dialect's arithmetic is not that of `rank` and `apply` above:
///   int rank(Operator op);
///   Computed apply(Operator op, double left, double right);
/// False when `operand` or `fault` gave false. Operators of a rank below `lowest` are left in the
/// text.
template <class Terms>
bool evaluate(Terms& terms, int lowest, double& value) {
  if (!terms.operand(value)) return false;
  for (;;) {
    const Operator op = terms.peek();
    int op_rank = 0;
    if constexpr (requires { terms.rank(op); }) {
      op_rank = terms.rank(op);
    } else {
      op_rank = rank(op);
    }
    if (op_rank == 0 || op_rank < lowest) return true;
    terms.take();
    double right = 0;
    if (!evaluate(terms, op_rank + 1, right)) return false;
    Computed computed;
    if constexpr (requires { terms.apply(op, value, right); }) {
      computed = terms.apply(op, value, right);
    } else {
      computed = apply(op, value, right);
    }
    if (computed.fault != MathFault::None) return terms.fault(computed.fault);
    value = computed.value;
  }
}

}  // namespace dripline::interpreter::language
