#include "gateway/interpreter/core/language/expression.hpp"

#include <array>
#include <cmath>

#include "protocol/base/units.hpp"

namespace dripline::interpreter::language {
namespace {

Computed checked(double value) {
  if (std::isnan(value)) return {0, MathFault::Undefined};
  if (std::isinf(value)) return {0, MathFault::Overflow};
  return {value, MathFault::None};
}

Computed from(bool claim) {
  return {claim ? 1.0 : 0.0, MathFault::None};
}

/// Multiples of 90 degrees come out exact: programs compare such values.
double exact_sine(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0 || std::fabs(turn) == 180) return 0;
  if (turn == 90) return 1;
  if (turn == -90) return -1;
  return std::sin(turn * (Angle::kPi / 180.0));
}

}  // namespace

std::string_view to_string(MathFault fault) {
  switch (fault) {
    case MathFault::None:
      return "no fault";
    case MathFault::DivisionByZero:
      return "division by zero";
    case MathFault::NegativeRoot:
      return "square root of a negative value";
    case MathFault::LogArgument:
      return "logarithm of zero or a negative value";
    case MathFault::PowerBase:
      return "power of zero or a negative base";
    case MathFault::Tangent:
      return "tangent has no value here";
    case MathFault::Overflow:
      return "value too large";
    case MathFault::Undefined:
      return "value is not defined";
  }
  return "unknown";
}

int rank(Operator op) {
  switch (op) {
    case Operator::None:
      return 0;
    case Operator::Power:
      return 4;
    case Operator::Multiply:
    case Operator::Divide:
    case Operator::IntegerDivide:
    case Operator::Modulo:
      return 3;
    case Operator::Add:
    case Operator::Subtract:
      return 2;
    default:
      return 1;
  }
}

Computed apply(Operator op, double left, double right) {
  const bool equal = std::fabs(left - right) <= kEqualWithin;
  switch (op) {
    case Operator::None:
      return {left, MathFault::None};
    case Operator::Power:
      if (left <= 0) return {0, MathFault::PowerBase};
      return checked(std::pow(left, right));
    case Operator::Multiply:
      return checked(left * right);
    case Operator::Divide:
      if (right == 0) return {0, MathFault::DivisionByZero};
      return checked(left / right);
    case Operator::IntegerDivide:
      if (right == 0) return {0, MathFault::DivisionByZero};
      return checked(std::trunc(left / right));
    case Operator::Modulo:
      if (right == 0) return {0, MathFault::DivisionByZero};
      return checked(left - right * std::trunc(left / right));
    case Operator::Add:
      return checked(left + right);
    case Operator::Subtract:
      return checked(left - right);
    case Operator::Equal:
      return from(equal);
    case Operator::NotEqual:
      return from(!equal);
    case Operator::Less:
      return from(!equal && left < right);
    case Operator::LessOrEqual:
      return from(equal || left < right);
    case Operator::Greater:
      return from(!equal && left > right);
    case Operator::GreaterOrEqual:
      return from(equal || left > right);
    case Operator::And:
      return from(left != 0 && right != 0);
    case Operator::Or:
      return from(left != 0 || right != 0);
    case Operator::ExclusiveOr:
      return from((left != 0) != (right != 0));
  }
  return {0, MathFault::Undefined};
}

Computed sine(double degrees) {
  return checked(exact_sine(degrees));
}
Computed cosine(double degrees) {
  return checked(exact_sine(degrees + 90));
}

Computed tangent(double degrees) {
  const double below = exact_sine(degrees + 90);
  if (below == 0) return {0, MathFault::Tangent};
  return checked(exact_sine(degrees) / below);
}

Computed arc_tangent(double y, double x) {
  if (x == 0 && y == 0) return {0, MathFault::Undefined};
  if (y == 0) return {x < 0 ? 180.0 : 0.0, MathFault::None};  // -0 must not turn into -180
  return checked(std::atan2(y, x) * (180.0 / Angle::kPi));
}

Computed square_root(double value) {
  if (value < 0) return {0, MathFault::NegativeRoot};
  return checked(std::sqrt(value));
}
Computed natural_logarithm(double value) {
  if (value <= 0) return {0, MathFault::LogArgument};
  return checked(std::log(value));
}
Computed exponential(double value) {
  return checked(std::exp(value));
}
Computed absolute(double value) {
  return checked(std::fabs(value));
}
Computed integer_part(double value) {
  return checked(std::trunc(value));
}
Computed rounded(double value) {
  return checked(std::round(value));
}

}  // namespace dripline::interpreter::language
