#include "gateway/interpreter/dialects/rs274ngc/reading/functions.hpp"

#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

struct FunctionName {
  const char* word;
  Function function;
};
constexpr std::array kFunctions{
    FunctionName{"ABS", Function::Abs},       FunctionName{"ACOS", Function::Acos},
    FunctionName{"ASIN", Function::Asin},     FunctionName{"ATAN", Function::Atan},
    FunctionName{"COS", Function::Cos},       FunctionName{"EXP", Function::Exp},
    FunctionName{"EXISTS", Function::Exists}, FunctionName{"FIX", Function::Fix},
    FunctionName{"FUP", Function::Fup},       FunctionName{"LN", Function::Ln},
    FunctionName{"ROUND", Function::Round},   FunctionName{"SIN", Function::Sin},
    FunctionName{"SQRT", Function::Sqrt},     FunctionName{"TAN", Function::Tan}};

double radians(double degrees) {
  return degrees * (Angle::kPi / 180);
}
double degrees(double radians) {
  return radians * (180 / Angle::kPi);
}

}  // namespace

Function take_function(const char*& at) {
  const char first = upper(*at);
  for (const FunctionName& each : kFunctions) {
    if (each.word[0] == first && take_word(at, each.word)) return each.function;
  }
  return Function::None;
}

bool compute(Run& run, Function function, std::uint32_t column, double& value) {
  switch (function) {
    case Function::Abs:
      value = std::fabs(value);
      return true;
    case Function::Acos:
      if (!(std::fabs(value) <= 1)) return run.fail(ErrorCode::AcosRange, column);
      value = degrees(std::acos(value));
      return true;
    case Function::Asin:
      if (!(std::fabs(value) <= 1)) return run.fail(ErrorCode::AsinRange, column);
      value = degrees(std::asin(value));
      return true;
    case Function::Cos:
      value = std::cos(radians(value));
      return true;
    case Function::Exp:
      value = std::exp(value);
      return std::isfinite(value) || run.fail(ErrorCode::NotFinite, column);
    case Function::Fix:
      value = std::floor(value);
      return true;
    case Function::Fup:
      value = std::ceil(value);
      return true;
    case Function::Ln:
      if (!(value > 0)) return run.fail(ErrorCode::LnZero, column);
      value = std::log(value);
      return true;
    case Function::Round:
      value = std::round(value);
      return true;
    case Function::Sin:
      value = std::sin(radians(value));
      return true;
    case Function::Sqrt:
      if (!(value >= 0)) return run.fail(ErrorCode::NegativeSqrt, column);
      value = std::sqrt(value);
      return true;
    default:
      value = std::tan(radians(value));
      return true;
  }
}

}  // namespace dripline::interpreter::rs274ngc
