#include "gateway/interpreter/dialects/centurion/reading/expression_reader.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/memory/pins.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"

namespace dripline::interpreter::centurion {
namespace {

using language::Computed;
using language::MathFault;
using language::Operator;

constexpr int kSumRank = 2;
constexpr int kProductRank = 3;
constexpr int kPowerRank = 4;
/// Nested brackets and signs; keeps a block from exhausting the stack.
constexpr int kMaxDepth = 64;

ErrorCode code_of(MathFault fault) {
  switch (fault) {
    case MathFault::DivisionByZero:
      return ErrorCode::DivisionByZero;
    case MathFault::NegativeRoot:
      return ErrorCode::NegativeRoot;
    case MathFault::LogArgument:
      return ErrorCode::LogArgument;
    case MathFault::PowerBase:
      return ErrorCode::PowerBase;
    case MathFault::Tangent:
      return ErrorCode::TangentOverflow;
    case MathFault::Overflow:
      return ErrorCode::FloatingOverflow;
    default:
      return ErrorCode::InvalidFloating;
  }
}

/// The terms that language::evaluate walks over.
class Terms {
 public:
  Terms(Run& run, const char*& at) : run_(run), at_(at) {}

  bool operand(double& value) {
    if (!skip_gaps(run_, at_)) return false;
    if (depth_ >= kMaxDepth) return here(ErrorCode::IllegalStatement, "expression nested too deep");
    ++depth_;
    const bool ok = signed_operand(value);
    --depth_;
    return ok;
  }

  Operator peek() {
    if (!skip_gaps(run_, at_)) return Operator::None;  // the caller finds the open comment again
    return operator_at(at_, after_);
  }
  void take() { at_ = after_; }
  bool fault(MathFault fault) {
    // The texts of the others are complete without it.
    return here(code_of(fault),
                fault == MathFault::Undefined ? language::to_string(fault) : std::string_view{});
  }

  bool close_bracket() {
    if (!skip_gaps(run_, at_)) return false;
    if (*at_ != ']') return here(ErrorCode::MissingCloseBracket, {});
    ++at_;
    return true;
  }

 private:
  bool here(ErrorCode code, std::string_view detail) {
    return run_.fail(code, run_.column(at_), detail);
  }

  bool signed_operand(double& value) {
    const char sign = *at_;
    if (sign != '-' && sign != '+') return plain_operand(value);
    ++at_;
    if (!operand(value)) return false;
    if (sign == '-') value = -value;
    return true;
  }

  bool plain_operand(double& value) {
    switch (kind_of(*at_)) {
      case CharKind::Digit:
      case CharKind::Point:
        return constant(value);
      case CharKind::OpenBracket:
        ++at_;
        return language::evaluate(*this, kSumRank, value) && close_bracket();
      case CharKind::Letter:
        return named_operand(value);
      default:
        return here(ErrorCode::BadNumber, "a value is expected here");
    }
  }

  bool constant(double& value) {
    const char* start = at_;
    const Number number = read_number(at_);
    value = number.value;
    if (number.fault == NumberFault::None) return true;
    at_ = start;
    switch (number.fault) {
      case NumberFault::TooManyDigits:
        return here(ErrorCode::TooManyDigits, {});
      case NumberFault::SecondPoint:
        return here(ErrorCode::TwoPoints, {});
      default:
        return here(ErrorCode::BadNumber, {});
    }
  }

  bool named_operand(double& value) {
    const Function function = take_function(at_);
    if (function != Function::None) return call(function, value);
    if (upper(*at_) != 'P') return here(ErrorCode::UnknownFunction, {});
    const char* start = at_;
    at_ = skip_blanks(at_ + 1);
    const bool is_byte = kind_of(*at_) == CharKind::Letter && upper(*at_) == 'B';
    if (is_byte) at_ = skip_blanks(at_ + 1);
    if (!is_digit(*at_)) return here(ErrorCode::BadNumber, "a parameter number is expected here");
    double number = 0;
    if (!constant(number)) return false;
    if (!is_byte) return read_parameter(run_, number, run_.column(start), value);
    if (!check_parameter_number(run_, number, kByteCount, run_.column(start))) return false;
    run_.start.note_byte_read(static_cast<int>(number));
    value = run_.parameters.byte(static_cast<int>(number));
    return true;
  }

  bool call(Function function, double& value) {
    if (!skip_gaps(run_, at_)) return false;
    if (*at_ != '[') return here(ErrorCode::MissingOpenBracket, {});
    ++at_;
    if (function == Function::Atan) return arc_tangent(value);
    double argument = 0;
    if (!language::evaluate(*this, kSumRank, argument) || !close_bracket()) return false;
    if (function == Function::Pin) return pin(argument, value);
    if (function == Function::Rnd) return random(argument, value);
    return finish(language::compute(function, argument), value);
  }

  bool finish(const Computed& computed, double& value) {
    value = computed.value;
    return computed.fault == MathFault::None || fault(computed.fault);
  }

  /// The argument is a fraction: the angle of the point (denominator, numerator).
  bool arc_tangent(double& value) {
    double numerator = 0;
    double denominator = 0;
    if (!product_before_slash(numerator)) return false;
    if (peek() != Operator::Divide) return here(ErrorCode::MissingSlash, {});
    take();
    if (!language::evaluate(*this, kProductRank, denominator) || !close_bracket()) return false;
    return finish(language::arc_tangent(numerator, denominator), value);
  }

  bool product_before_slash(double& value) {
    if (!language::evaluate(*this, kPowerRank, value)) return false;
    while (peek() == Operator::Multiply) {
      take();
      double factor = 0;
      if (!language::evaluate(*this, kPowerRank, factor)) return false;
      const Computed computed = language::apply(Operator::Multiply, value, factor);
      if (!finish(computed, value)) return false;
    }
    return true;
  }

  bool pin(double number, double& value) {
    const auto pin_number = static_cast<int>(std::clamp(number, -1.0, 99999.0));
    if (pin_number != number) return here(ErrorCode::ParameterOutOfRange, "pin number");
    return read_pin(run_, pin_number, run_.column(at_), value);
  }

  /// A whole number from 0 up to below `limit`; the same sequence in every run.
  bool random(double limit, double& value) {
    if (!(limit >= 1) || limit > 1e9) return here(ErrorCode::ParameterOutOfRange, "RND limit");
    std::uint64_t& state = run_.state.random;
    state = state * 6364136223846793005u + 1442695040888963407u;
    value = std::floor(static_cast<double>(state >> 11) * 0x1p-53 * std::trunc(limit));
    return true;
  }

  Run& run_;
  const char*& at_;
  const char* after_ = nullptr;
  int depth_ = 0;
};

}  // namespace

bool skip_gaps(Run& run, const char*& at) {
  for (;;) {
    at = skip_blanks(at);
    if (*at != '(') return true;
    const char* close = at;
    while (*close != ')' && !is_end_of_block(*close)) ++close;
    if (*close != ')') return run.fail(ErrorCode::CommentNotClosed, run.column(at));
    at = close + 1;
  }
}

bool read_expression(Run& run, const char*& at, double& value) {
  Terms terms(run, at);
  return language::evaluate(terms, kSumRank, value) && skip_gaps(run, at);
}

bool read_condition(Run& run, const char*& at, bool& holds) {
  double left = 0;
  double right = 0;
  if (!read_expression(run, at, left)) return false;
  const char* after = at;
  const Operator relation = operator_at(at, after);
  if (!language::is_comparison(relation)) {
    return run.fail(ErrorCode::IllegalRelation, run.column(at), "a condition compares two values");
  }
  at = after;
  if (!read_expression(run, at, right)) return false;
  holds = language::apply(relation, left, right).value != 0;
  return true;
}

bool read_word_value(Run& run, const char*& at, double& value, unsigned& digits) {
  if (!skip_gaps(run, at)) return false;
  Terms terms(run, at);
  digits = 0;
  if (*at == '[') {
    ++at;
    return language::evaluate(terms, kSumRank, value) && terms.close_bracket();
  }
  const char* start = at;
  const Number number = read_number(at);
  value = number.value;
  digits = digits_of(number);
  switch (number.fault) {
    case NumberFault::None:
      return true;
    case NumberFault::TooManyDigits:
      return run.fail(ErrorCode::TooManyDigits, run.column(start));
    case NumberFault::SecondPoint:
      return run.fail(ErrorCode::TwoPoints, run.column(start));
    case NumberFault::NoDigits:
      break;
  }
  return run.fail(ErrorCode::BadNumber, run.column(start), "a number is expected here");
}

bool read_whole(Run& run, const char*& at, double limit, std::uint32_t& value) {
  const char* start = at;
  double number = 0;
  unsigned digits = 0;
  if (!read_word_value(run, at, number, digits)) return false;
  if (!(number >= 0) || number > limit || number != std::trunc(number)) {
    return run.fail(ErrorCode::ParameterOutOfRange, run.column(start),
                    fmt::format("{} is not a whole number from 0 to {}", number, limit));
  }
  value = static_cast<std::uint32_t>(number);
  return true;
}

bool check_parameter_number(Run& run, double number, int count, std::uint32_t column) {
  if (number >= 0 && number < count && number == std::trunc(number)) return true;
  return run.fail(ErrorCode::ParameterOutOfRange, column,
                  fmt::format("{} is not a parameter number from 0 to {}", number, count - 1));
}

bool read_parameter(Run& run, double number, std::uint32_t column, double& value) {
  if (!check_parameter_number(run, number, kParameterCount, column)) return false;
  const int index = static_cast<int>(number);
  value = run.parameters[index];
  if (index >= kFirstStatus && index <= kLastStatus) {
    value = status_parameter(run.state, run.parameters, index).value_or(value);
  }
  // a change that waits for G11 reads as it was written
  for (const DataChange& change : run.state.data_changes) {
    if (change.number != index) continue;
    value = change.value;
    return true;
  }
  run.start.note_read(index);
  return true;
}

}  // namespace dripline::interpreter::centurion
