#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"

#include <fmt/core.h>
#include <cmath>

namespace dripline::interpreter::tnc155 {
namespace {

/// A parameter shows five digits before and three after the point.
constexpr double kLargest = 99'999.999;

/// Sine of an angle in degrees; exact at multiples of 90 degrees.
double sine(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (std::fabs(turn) == 180) return 0;
  if (std::fabs(turn) == 90) return turn > 0 ? 1 : -1;
  return std::sin(turn * (Angle::kPi / 180));
}
double cosine(double degrees) {
  const double turn = std::fabs(std::remainder(degrees, 360.0));
  if (turn == 90) return 0;
  if (turn == 180) return -1;
  return std::cos(turn * (Angle::kPi / 180));
}

}  // namespace

bool compute(Run& run, const Block& block) {
  const double a = run.number(block.first);
  const double b = run.number(block.second);
  double result = a;
  switch (block.function) {
    case 0:
      break;
    case 1:
      result = a + b;
      break;
    case 2:
      result = a - b;
      break;
    case 3:
      result = a * b;
      break;
    case 4:
      if (b == 0) return run.fail(ErrorCode::ArithmeticalError, fmt::format("{} DIV 0", a));
      result = a / b;
      break;
    case 5:
      if (a < 0) return run.fail(ErrorCode::ArithmeticalError, fmt::format("SQRT of {}", a));
      result = std::sqrt(a);
      break;
    case 6:
      result = sine(a);
      break;
    case 7:
      result = cosine(a);
      break;
    case 8:
      result = std::hypot(a, b);
      break;
    default:
      return run.fail(ErrorCode::BlockFormatIncorrect, fmt::format("FN {}", block.function));
  }
  if (!(std::fabs(result) <= kLargest)) {
    return run.fail(ErrorCode::ArithmeticalError,
                    fmt::format("Q{} would be {}, beyond {}", block.target, result, kLargest));
  }
  run.set_q(block.target, result);
  return true;
}

bool is_true(Run& run, const Block& block) {
  const double a = run.number(block.first);
  const double b = run.number(block.second);
  switch (block.function) {
    case 9:
      return a == b;
    case 10:
      return a != b;
    case 11:
      return a > b;
    default:
      return a < b;
  }
}

}  // namespace dripline::interpreter::tnc155
