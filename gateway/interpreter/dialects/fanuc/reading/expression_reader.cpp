#include "gateway/interpreter/dialects/fanuc/reading/expression_reader.hpp"

#include <cmath>
#include <optional>

#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/parameters.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variable_names.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"

namespace dripline::interpreter::fanuc {
namespace {

using language::Computed;
using language::MathFault;
using language::Operator;

constexpr int kConditionRank = 1;
constexpr int kSumRank = 2;
/// Brackets within one another, those of functions included.
constexpr int kMaxBrackets = 5;
/// Signs and # within one another; keeps a block from using up the stack.
constexpr int kMaxDepth = 64;
constexpr double kLastVariable = 199'999;

double or_zero(double value) {
  return std::isnan(value) ? 0 : value;
}

const DiagnosticRow& code_of(MathFault fault) {
  switch (fault) {
    case MathFault::DivisionByZero:
      return ErrorCode::DivisionByZero;
    case MathFault::NegativeRoot:
    case MathFault::LogArgument:
    case MathFault::Undefined:
      return ErrorCode::IllegalArgument;
    default:
      return ErrorCode::Overflow;
  }
}

/// A null variable differs from 0 in EQ and NE only.
Computed compare(Operator op, double left, double right) {
  if (op != Operator::Equal && op != Operator::NotEqual) {
    return language::apply(op, or_zero(left), or_zero(right));
  }
  if (!std::isnan(left) && !std::isnan(right)) return language::apply(op, left, right);
  const bool equal = std::isnan(left) && std::isnan(right);
  return {equal == (op == Operator::Equal) ? 1.0 : 0.0, MathFault::None};
}

/// On 32 bits, both sides rounded to whole numbers.
Computed combine_bits(Operator op, double left, double right) {
  constexpr double kMax = 4294967295.0;
  const double a = std::round(left);
  const double b = std::round(right);
  if (!(std::fabs(a) <= kMax && std::fabs(b) <= kMax)) return {0, MathFault::Overflow};
  const auto x = static_cast<std::uint32_t>(static_cast<std::int64_t>(a));
  const auto y = static_cast<std::uint32_t>(static_cast<std::int64_t>(b));
  const std::uint32_t bits = op == Operator::And ? x & y : op == Operator::Or ? x | y : x ^ y;
  const bool is_signed = a < 0 || b < 0;
  return {
      is_signed ? static_cast<double>(static_cast<std::int32_t>(bits)) : static_cast<double>(bits),
      MathFault::None};
}

/// The remainder of whole numbers, with the sign of the first.
Computed remainder_of(double left, double right) {
  const double divisor = std::round(right);
  if (divisor == 0) return {0, MathFault::DivisionByZero};
  return {std::fmod(std::round(left), divisor), MathFault::None};
}

Computed power_of(double base, double exponent) {
  if (base == 0 && exponent < 0) return {0, MathFault::DivisionByZero};
  if (base < 0 && exponent != std::trunc(exponent)) return {0, MathFault::Undefined};
  const double value = std::pow(base, exponent);
  return {value, std::isfinite(value) ? MathFault::None : MathFault::Overflow};
}

Computed combine(Operator op, double left, double right) {
  if (op == Operator::Modulo) return remainder_of(or_zero(left), or_zero(right));
  if (language::is_comparison(op)) return compare(op, left, right);
  const bool is_of_bits = op == Operator::And || op == Operator::Or || op == Operator::ExclusiveOr;
  if (is_of_bits) return combine_bits(op, or_zero(left), or_zero(right));
  return language::apply(op, or_zero(left), or_zero(right));
}

/// Decimal digits as groups of four bits, and back.
Computed bcd_of(double value) {
  const double whole = std::round(value);
  if (!(whole >= 0 && whole <= 99'999'999)) return {0, MathFault::Undefined};
  auto rest = static_cast<std::uint32_t>(whole);
  std::uint32_t coded = 0;
  for (unsigned shift = 0; rest != 0; rest /= 10, shift += 4) coded |= rest % 10 << shift;
  return {static_cast<double>(coded), MathFault::None};
}
Computed binary_of(double value) {
  const double whole = std::round(value);
  if (!(whole >= 0 && whole <= 4294967295.0)) return {0, MathFault::Undefined};
  const auto coded = static_cast<std::uint32_t>(whole);
  double result = 0;
  for (int shift = 28; shift >= 0; shift -= 4) {
    const std::uint32_t digit = coded >> shift & 0xF;
    if (digit > 9) return {0, MathFault::Undefined};
    result = result * 10 + digit;
  }
  return {result, MathFault::None};
}

Computed cut_fraction(double value, bool away) {
  constexpr double kNudge = 1e-9;  // what a chain of sums leaves of a whole number stays whole
  const double near = std::round(value);
  if (std::fabs(value - near) <= kNudge) return {near, MathFault::None};
  const double whole = std::trunc(value);
  return {away ? whole + std::copysign(1.0, value) : whole, MathFault::None};
}

Computed degrees_of(double radians, bool is_signed) {
  double degrees = radians * (180.0 / Angle::kPi);
  if (!is_signed && degrees < 0) degrees += 360;
  return {degrees, MathFault::None};
}

class Terms {
 public:
  Terms(Run& run, const char*& at, bool takes_conditions, double least)
      : run_(run), at_(at), takes_conditions_(takes_conditions), least_(least) {}

  // What language::evaluate walks over.
  Operator peek() {
    skip_gaps();
    const Operator op = operator_at(at_, after_);
    if (op == Operator::Modulo && !run_.options.has_later_functions) [[unlikely]]
      return Operator::None;  // what follows the expression is then refused
    return language::is_comparison(op) && !takes_conditions_ ? Operator::None : op;
  }
  void take() { at_ = after_; }
  int rank(Operator op) const { return fanuc::rank(op); }
  Computed apply(Operator op, double left, double right) {
    if (takes_conditions_ && language::is_comparison(op)) {
      const std::uint32_t level = 1u << brackets_;
      is_chained_ |= (compared_ & level) != 0;
      compared_ |= level;
      has_comparison_ = true;
    }
    return combine(op, left, right);
  }
  bool fault(MathFault fault) { return here(code_of(fault), {}); }

  bool operand(double& value) {
    skip_gaps();
    if (depth_ >= kMaxDepth) return here(ErrorCode::MacroFormat, "nested too deep");
    ++depth_;
    const bool ok = signed_operand(value);
    --depth_;
    return ok;
  }

  bool is_condition() const { return has_comparison_ && !is_chained_; }

  /// `at` is on the opening bracket. With `second`, another value may follow a comma.
  bool bracketed(double& value, std::optional<double>* second = nullptr) {
    if (brackets_ == kMaxBrackets) return here(ErrorCode::Brackets, "more than 5 levels");
    ++brackets_;
    compared_ &= ~(1u << brackets_);
    ++at_;
    if (!language::evaluate(*this, takes_conditions_ ? kConditionRank : kSumRank, value))
      return false;
    skip_gaps();
    if (*at_ == ',' && second != nullptr) {
      ++at_;
      if (!language::evaluate(*this, kSumRank, second->emplace(0))) return false;
      skip_gaps();
    }
    if (*at_ != ']') return here(*at_ == '\n' ? ErrorCode::Brackets : ErrorCode::MacroFormat, {});
    ++at_;
    --brackets_;
    return true;
  }

 private:
  bool here(const DiagnosticRow& code, std::string_view detail) {
    return run_.fail(code, run_.column(at_), detail);
  }
  bool finish(const Computed& computed, double& value) {
    value = computed.value;
    return computed.fault == MathFault::None || fault(computed.fault);
  }
  void skip_gaps() {
    for (;;) {
      at_ = skip_blanks(at_);
      if (*at_ != '(') return;
      while (*at_ != ')' && at_ != run_.text.end()) ++at_;
      if (*at_ == ')') ++at_;
    }
  }

  bool signed_operand(double& value) {
    const char sign = *at_;
    if (sign != '-' && sign != '+') return plain_operand(value);
    ++at_;
    if (!operand(value)) return false;
    value = sign == '-' ? -or_zero(value) : or_zero(value);
    return true;
  }

  bool plain_operand(double& value) {
    switch (kind_of(*at_)) {
      case CharKind::Digit:
      case CharKind::Point:
        return constant(value);
      case CharKind::OpenBracket:
        return is_named_variable(at_) ? named_variable(value) : bracketed(value);
      case CharKind::Hash:
        return variable(value);
      case CharKind::Letter:
        return call(value);
      default:
        return here(ErrorCode::MacroFormat, "a value is expected here");
    }
  }

  bool constant(double& value) {
    NumberText number;
    const char* start = at_;
    at_ = read_number<NumberRules{.skip_blanks = true}>(at_, nullptr, number);
    value = number.value;
    if (number.fault == NumberFault::None) return true;
    at_ = start;
    return here(number.fault == NumberFault::TooManyDigits ? ErrorCode::TooManyDigits
                                                           : ErrorCode::MacroFormat,
                "number");
  }

  bool variable(double& value) {
    const char* start = at_;
    int number = 0;
    return variable_number(number) && read_variable(run_, number, run_.column(start), value);
  }
  bool named_variable(double& value) {
    const char* start = at_;
    int number = 0;
    return read_variable_name(run_, at_, number) &&
           read_variable(run_, number, run_.column(start), value);
  }

 public:
  bool variable_number(int& number) {
    const char* start = at_;
    ++at_;
    skip_gaps();
    double value = 0;
    if (is_digit(*at_)) {
      if (!constant(value)) return false;
    } else if (*at_ == '[') {
      const bool takes_conditions = std::exchange(takes_conditions_, false);
      const bool ok = bracketed(value);
      takes_conditions_ = takes_conditions;
      if (!ok) return false;
    } else if (*at_ == '#') {
      run_.block.warn(WarningCode::NestedReference, run_.column(start));
      if (depth_ >= kMaxDepth) return here(ErrorCode::MacroFormat, "nested too deep");
      ++depth_;
      const bool ok = variable(value);
      --depth_;
      if (!ok) return false;
    } else {
      const bool is_name = is_letter(*at_) || *at_ == '<' || *at_ == '_';
      return here(ErrorCode::MacroFormat, is_name ? "a name of a variable is written [#NAME]"
                                                  : "# needs the number of a variable");
    }
    value = std::round(or_zero(value));
    if (!(value >= 0 && value <= kLastVariable)) {
      return run_.fail(ErrorCode::IllegalVariable, run_.column(start));
    }
    number = static_cast<int>(value);
    return true;
  }

 private:
  bool call(double& value) {
    const char* start = at_;
    if (take_word(at_, "PRM")) return parameter(start, value);
    const Function function = take_function(at_);
    if (function == Function::Pow && !run_.options.has_later_functions) {
      at_ = start;
      return here(ErrorCode::MacroFormat, "POW on this model");
    }
    if (function == Function::None) return here(ErrorCode::MacroFormat, "unknown function");
    skip_gaps();
    if (*at_ != '[') return here(ErrorCode::MacroFormat, "[ is expected here");
    double argument = 0;
    std::optional<double> second;
    const bool takes_two = function == Function::Atan || function == Function::Pow;
    if (!bracketed(argument, takes_two ? &second : nullptr)) return false;
    argument = or_zero(argument);
    if (function == Function::Atan) {
      return second ? arc_tangent_of(argument, *second, value) : arc_tangent(argument, value);
    }
    if (function == Function::Pow) {
      if (!second) return here(ErrorCode::MacroFormat, "POW[base, exponent]");
      return finish(power_of(argument, or_zero(*second)), value);
    }
    return finish(compute(function, argument), value);
  }

  /// PRM[number] and PRM[number,bit]; the axis of /[k] has no parameter here.
  bool parameter(const char* start, double& value) {
    if (!run_.options.has_long_variables) {
      at_ = start;
      return here(ErrorCode::MacroFormat, "PRM on this model");
    }
    skip_gaps();
    if (*at_ != '[') return here(ErrorCode::MacroFormat, "[ is expected here");
    double number = 0;
    std::optional<double> bit;
    if (!bracketed(number, &bit)) return false;
    skip_gaps();
    const bool has_axis = *at_ == '/' && *skip_blanks(at_ + 1) == '[';
    return read_parameter(run_, {or_zero(number), bit, has_axis}, run_.column(start), value);
  }

  /// ATAN[y]/[x], or ATAN[y] alone.
  bool arc_tangent(double y, double& value) {
    skip_gaps();
    // After the end of the block there is nothing to look at.
    const char* after = *at_ == '/' ? skip_blanks(at_ + 1) : at_;
    if (*after != '[') return finish(degrees_of(std::atan(y), true), value);
    at_ = after;
    double x = 0;
    return bracketed(x) && arc_tangent_of(y, x, value);
  }
  bool arc_tangent_of(double y, double x, double& value) {
    Computed computed = language::arc_tangent(y, or_zero(x));
    if (!run_.options.atan_is_signed && computed.value < 0) computed.value += 360;
    return finish(computed, value);
  }

  Computed compute(Function function, double argument) const {
    switch (function) {
      case Function::Asin:
        if (!(std::fabs(argument) <= 1)) return {0, MathFault::Undefined};
        return degrees_of(std::asin(argument), run_.options.atan_is_signed);
      case Function::Acos:
        if (!(std::fabs(argument) <= 1)) return {0, MathFault::Undefined};
        return degrees_of(std::acos(argument), true);
      case Function::Round:
        return {std::round(argument / least_) * least_, MathFault::None};
      case Function::Fix:
        return cut_fraction(argument, false);
      case Function::Fup:
        return cut_fraction(argument, true);
      case Function::Bin:
        return binary_of(argument);
      case Function::Bcd:
        return bcd_of(argument);
      default:
        return language::compute(function, argument);
    }
  }

  Run& run_;
  const char*& at_;
  const char* after_ = nullptr;  ///< of the operator seen last
  bool takes_conditions_;
  bool has_comparison_ = false;
  bool is_chained_ = false;     ///< two comparisons within one pair of brackets
  std::uint32_t compared_ = 0;  ///< bit per level of brackets
  double least_;
  int depth_ = 0;
  int brackets_ = 0;
};

/// The control's own range.
bool check_range(Run& run, const char* at, double value) {
  constexpr double kMax = 1e47;
  if (std::isnan(value) || std::fabs(value) <= kMax) return true;
  return run.fail(ErrorCode::Overflow, run.column(at));
}

}  // namespace

bool read_expression(Run& run, const char*& at, double& value) {
  Terms terms(run, at, false, 1);
  if (!language::evaluate(terms, kSumRank, value)) return false;
  if (const char* after = at; !run.options.has_later_functions && take_word(after, "MOD")) {
    return run.fail(ErrorCode::MacroFormat, run.column(skip_blanks(at)), "MOD on this model");
  }
  return check_range(run, at, value);
}

bool read_condition(Run& run, const char*& at, bool& holds) {
  at = skip_blanks(at);
  if (*at != '[') return run.fail(ErrorCode::MacroFormat, run.column(at), "[ is expected here");
  Terms terms(run, at, true, 1);
  double value = 0;
  const char* start = at;
  if (!terms.bracketed(value)) return false;
  // What a number is worth as a condition, and `1 EQ #1 AND 2 EQ #2`, is not stated.
  if (!terms.is_condition()) {
    return run.fail(ErrorCode::MacroFormat, run.column(start),
                    "a condition is one comparison; several are each in brackets");
  }
  holds = or_zero(value) != 0;
  return true;
}

bool read_operand(Run& run, const char*& at, double least, double& value) {
  Terms terms(run, at, false, least);
  const bool is_negative = *at == '-';
  if (*at == '-' || *at == '+') at = skip_blanks(at + 1);
  if (!terms.operand(value)) return false;
  if (is_negative) value = -value;  // of null still null
  return check_range(run, at, value);
}

bool read_variable_number(Run& run, const char*& at, int& number) {
  Terms terms(run, at, false, 1);
  return terms.variable_number(number);
}

}  // namespace dripline::interpreter::fanuc
