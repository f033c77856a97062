#include "gateway/interpreter/dialects/rs274ngc/reading/known_expressions.hpp"

#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/reading/functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

namespace dripline::interpreter::rs274ngc {

using language::Computed;
using language::MathFault;
using language::Operator;

namespace {

/// Comparisons of the later language.
constexpr double kSameWithin = 1e-6;

}  // namespace

double angle_of(double y, double x) {
  if (y == 0) return x < 0 ? 180 : 0;  // -0 must not turn into -180; 0/0 is 0
  return std::atan2(y, x) * (180 / Angle::kPi);
}

Computed computed(Operator op, double left, double right) {
  const auto claim = [](bool holds) { return Computed{holds ? 1.0 : 0.0, MathFault::None}; };
  const auto finite = [](double value) {
    return Computed{value, std::isfinite(value) ? MathFault::None : MathFault::Overflow};
  };
  switch (op) {
    case Operator::Add:
      return finite(left + right);
    case Operator::Subtract:
      return finite(left - right);
    case Operator::Multiply:
      return finite(left * right);
    case Operator::Power: {
      if (left < 0 && right != std::floor(right)) return {0, MathFault::PowerBase};
      const double power = std::pow(left, right);
      return {power, std::isfinite(power) ? MathFault::None : MathFault::Overflow};
    }
    case Operator::Modulo: {
      const double rest = std::fmod(left, right);
      if (std::isnan(rest)) return {0, MathFault::Undefined};
      return {rest < 0 ? rest + std::fabs(right) : rest, MathFault::None};
    }
    case Operator::Equal:
      return claim(std::fabs(left - right) < kSameWithin);
    case Operator::NotEqual:
      return claim(std::fabs(left - right) >= kSameWithin);
    case Operator::Less:
      return claim(left < right);
    case Operator::LessOrEqual:
      return claim(left <= right || std::fabs(left - right) < kSameWithin);
    case Operator::Greater:
      return claim(left > right);
    case Operator::GreaterOrEqual:
      return claim(left >= right || std::fabs(left - right) < kSameWithin);
    default:
      return language::apply(op, left, right);
  }
}

bool compute_steps(Run& run, const KnownExpression& known, double& value) {
  using Kind = KnownExpression::Step::Kind;
  std::array<double, KnownExpression::kMaxSteps + 1> stack;
  double* top = stack.data();  // after the last value
  for (const KnownExpression::Step& step : known.steps()) {
    switch (step.kind) {
      case Kind::Constant:
        *top++ = step.value;
        break;
      case Kind::Parameter:
        *top++ = run.parameters[step.parameter];
        break;
      case Kind::Negate:
        top[-1] = -top[-1];
        break;
      case Kind::Operate: {
        --top;
        const Computed result = computed(step.op, top[-1], top[0]);
        if (result.fault != MathFault::None) return false;
        top[-1] = result.value;
        break;
      }
      case Kind::Compute:
        if (!compute(run, step.function, 0, top[-1])) return false;
        break;
      case Kind::ArcTangent:
        --top;
        top[-1] = angle_of(top[-1], top[0]);
        break;
    }
  }
  value = stack[0];
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
