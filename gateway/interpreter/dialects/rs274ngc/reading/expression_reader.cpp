#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/core.h>

#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/parameter_access.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/functions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/known_expressions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {

namespace {

using language::Computed;
using language::MathFault;
using language::Operator;
using Kind = KnownExpression::Step::Kind;

constexpr int kMaxDepth = 64;
/// A value this near to a whole number is one (NIST 3.3).
constexpr double kWholeWithin = 0.0001;

/// The walk over one expression and all that is inside it.
class Terms {
 public:
  /// Its steps are put down in `known`.
  Terms(Run& run, const char*& at, KnownExpression& known) : run_(run), at_(at), known_(known) {}

  bool operand(double& value);
  Operator peek();
  void take() { at_ = after_; }
  int rank(Operator op) const;
  Computed apply(Operator op, double left, double right) {
    known_.add({.kind = Kind::Operate, .op = op});
    return computed(op, left, right);
  }
  bool fault(MathFault fault) { return run_.fail(code_of(fault), run_.column(at_)); }

  bool bracketed(double& value);

 private:
  static const DiagnosticRow& code_of(MathFault fault) {
    switch (fault) {
      case MathFault::DivisionByZero:
        return ErrorCode::DivideByZero;
      case MathFault::PowerBase:
        return ErrorCode::NegativePower;
      default:
        return ErrorCode::NotFinite;
    }
  }
  bool parameter(double& value);
  bool function(double& value);
  bool arc_tangent(double& value);
  bool exists(double& value);
  bool argument(double& value);
  Operator operator_here(const char* at);
  bool is_comparison_allowed() const { return run_.is_linuxcnc(); }

  Run& run_;
  const char*& at_;
  KnownExpression& known_;
  const char* after_ = nullptr;       ///< of the operator that was peeked at,
  const char* peeked_at_ = nullptr;   ///< where it is,
  Operator peeked_ = Operator::None;  ///< and which
  int depth_ = 0;
};

int Terms::rank(Operator op) const {
  switch (op) {
    case Operator::None:
      return 0;
    case Operator::Power:
      return 6;
    case Operator::Multiply:
    case Operator::Divide:
    case Operator::Modulo:
      return 5;
    case Operator::And:
    case Operator::Or:
    case Operator::ExclusiveOr:
      return run_.is_linuxcnc() ? 2 : 4;
    default:
      return language::is_comparison(op) ? 3 : 4;
  }
}

Operator Terms::operator_here(const char* at) {
  after_ = at + 1;
  switch (upper(*at)) {
    case '+':
      return Operator::Add;
    case '-':
      return Operator::Subtract;
    case '/':
      return Operator::Divide;
    case '*':
      if (*skip_blanks(at + 1) != '*') return Operator::Multiply;
      after_ = skip_blanks(at + 1) + 1;
      return Operator::Power;
    default:
      break;
  }
  struct Spelling {
    const char* word;
    Operator op;
  };
  static constexpr std::array kWords{
      Spelling{"MOD", Operator::Modulo},      Spelling{"AND", Operator::And},
      Spelling{"XOR", Operator::ExclusiveOr}, Spelling{"OR", Operator::Or},
      Spelling{"EQ", Operator::Equal},        Spelling{"NE", Operator::NotEqual},
      Spelling{"GT", Operator::Greater},      Spelling{"GE", Operator::GreaterOrEqual},
      Spelling{"LT", Operator::Less},         Spelling{"LE", Operator::LessOrEqual}};
  const char first = upper(*at);
  for (const Spelling& spelling : kWords) {
    if (spelling.word[0] != first) continue;
    after_ = at;
    if (!take_word(after_, spelling.word)) continue;
    if (language::is_comparison(spelling.op) && !is_comparison_allowed()) break;
    return spelling.op;
  }
  return Operator::None;
}

Operator Terms::peek() {
  at_ = skip_blanks(at_);
  if (*at_ == ']') return Operator::None;
  // One of a lower rank is seen again by every evaluation that it ends.
  if (at_ != peeked_at_) {
    peeked_at_ = at_;
    peeked_ = operator_here(at_);
  }
  return peeked_;
}

bool Terms::bracketed(double& value) {
  ++at_;  // [
  if (!language::evaluate(*this, 1, value)) return false;
  at_ = skip_blanks(at_);
  if (*at_ == ']') [[likely]] {
    ++at_;
    return true;
  }
  return run_.fail(
      is_end_of_line(*at_) ? ErrorCode::UnclosedExpression : ErrorCode::UnknownOperation,
      run_.column(at_));
}

bool Terms::operand(double& value) {
  at_ = skip_blanks(at_);
  const char c = *at_;
  if (is_digit(c) || c == '.') [[likely]] {
    int small = 0;  // as nearly all constants
    if (take_small_number(at_, small)) {
      value = small;
    } else if (!read_number_at(run_, at_, value)) {
      return false;
    }
    known_.add({.kind = Kind::Constant, .value = value});
    return true;
  }
  if (depth_ >= kMaxDepth) return run_.fail(ErrorCode::NestedTooDeep, run_.column(at_));
  ++depth_;
  bool ok = false;
  if (c == '[') {
    ok = bracketed(value);
  } else if (c == '#') {
    ++at_;
    ok = parameter(value);
  } else if (c == '-' || c == '+') {
    const char next = *skip_blanks(at_ + 1);
    if (run_.is_linuxcnc() && !is_digit(next) && next != '.') {
      ++at_;
      ok = operand(value);
      if (c == '-') {
        value = -value;
        known_.add({.kind = Kind::Negate});
      }
    } else {
      ok = read_number_at(run_, at_, value);
      known_.add({.kind = Kind::Constant, .value = value});
    }
  } else if (is_letter(c)) {
    ok = function(value);
  } else {
    run_.fail(is_end_of_line(c) ? ErrorCode::NoValue : ErrorCode::BadNumber, run_.column(at_));
  }
  --depth_;
  return ok;
}

/// After the #: an index, which is itself a real value, or a name.
bool Terms::parameter(double& value) {
  at_ = skip_blanks(at_);
  const char* start = at_;
  int small = 0;
  if (take_small_number(at_, small)) [[likely]] {
    if (small < kFirstReadOnly) {
      known_.add({.kind = Kind::Parameter, .parameter = static_cast<std::uint16_t>(small)});
    } else {
      known_.spoil();  // it shows the state, or is none
    }
    return read_parameter(run_, small, run_.column(start), value);
  }
  known_.spoil();
  if (*at_ == '<' && run_.is_linuxcnc()) {
    if (!read_name(run_, at_, run_.scratch)) return false;
    return read_named(run_, run_.scratch, run_.column(start), value);
  }
  double index = 0;
  if (!operand(index)) return false;
  const double whole = std::round(index);
  if (!(std::fabs(index - whole) <= kWholeWithin)) {
    return run_.fail(ErrorCode::NotInteger, run_.column(start), fmt::format("#{}", index));
  }
  return read_parameter(run_, whole, run_.column(start), value);
}

bool Terms::argument(double& value) {
  at_ = skip_blanks(at_);
  if (*at_ != '[') return run_.fail(ErrorCode::FunctionBracket, run_.column(at_));
  return bracketed(value);
}

bool Terms::arc_tangent(double& value) {
  double second = 0;
  if (!argument(value)) return false;
  at_ = skip_blanks(at_);
  if (*at_ != '/') return run_.fail(ErrorCode::AtanSlash, run_.column(at_));
  at_ = skip_blanks(at_ + 1);
  if (*at_ != '[') return run_.fail(ErrorCode::AtanBracket, run_.column(at_));
  if (!bracketed(second)) return false;
  value = angle_of(value, second);
  known_.add({.kind = Kind::ArcTangent});
  return true;
}

bool Terms::exists(double& value) {
  known_.spoil();
  at_ = skip_blanks(at_);
  if (*at_ != '[') return run_.fail(ErrorCode::FunctionBracket, run_.column(at_));
  at_ = skip_blanks(at_ + 1);
  const char* start = at_;
  if (*at_ != '#') return run_.fail(ErrorCode::NotAParameter, run_.column(start));
  at_ = skip_blanks(at_ + 1);
  bool is_there = false;
  if (*at_ == '<') {
    if (!read_name(run_, at_, run_.scratch)) return false;
    if (!is_defined(run_, run_.scratch, is_there)) return false;
  } else {
    int index = 0;
    if (!read_integer(run_, at_, index)) return false;
    is_there = parameter_for_text(run_, index).has_value();
  }
  at_ = skip_blanks(at_);
  if (*at_ != ']') return run_.fail(ErrorCode::UnclosedExpression, run_.column(at_));
  ++at_;
  value = is_there ? 1 : 0;
  return true;
}

bool Terms::function(double& value) {
  const char* start = at_;
  const Function function = take_function(at_);
  switch (function) {
    case Function::None:
      return run_.fail(ErrorCode::UnknownFunction, run_.column(start));
    case Function::Atan:
      return arc_tangent(value);
    case Function::Exists:
      if (!run_.is_linuxcnc()) return run_.fail(ErrorCode::UnknownFunction, run_.column(start));
      return exists(value);
    default:
      if (!argument(value)) return false;
      known_.add({.kind = Kind::Compute, .function = function});
      return compute(run_, function, run_.column(start), value);
  }
}

/// An expression that was read before is only computed; where that fails, reading it once more
/// reports the error at its place.
bool read_or_compute(Run& run, const char*& at, double& value, bool (Terms::*read)(double&)) {
  const ProgramIndex program = run.here.program;
  const std::uint64_t offset = run.here.offset + static_cast<std::uint64_t>(at - run.line_begin);
  if (const auto* known = run.expressions.find(program, offset)) {
    if (compute_steps(run, known->expression, value)) [[likely]] {
      at += known->length;
      return true;
    }
    run.pause = Pause::None;
  }
  KnownExpressions::Slot slot{.offset = offset, .program = program, .expression = {}};
  const char* start = at;
  Terms terms(run, at, slot.expression);
  if (!(terms.*read)(value)) return false;
  slot.length = static_cast<std::uint32_t>(at - start);
  if (slot.expression.is_good()) run.expressions.keep(slot);
  return true;
}

}  // namespace

bool read_computed_value(Run& run, const char*& at, double& value) {
  if (*at == '-' || *at == '+') {
    const char* after_sign = skip_blanks(at + 1);
    if (is_digit(*after_sign) || *after_sign == '.') return read_number_at(run, at, value);
    if (!run.is_linuxcnc()) return run.fail(ErrorCode::NoDigits, run.column(at));
  }
  return read_or_compute(run, at, value, &Terms::operand);
}

bool read_integer(Run& run, const char*& at, int& value) {
  constexpr double kMax = 1e9;
  at = skip_blanks(at);
  const char* start = at;
  if (take_small_number(at, value)) [[likely]]
    return true;
  double real = 0;
  if (!read_value(run, at, real)) return false;
  const double whole = std::round(real);
  if (!(std::fabs(real - whole) <= kWholeWithin) || !(std::fabs(whole) <= kMax)) {
    return run.fail(ErrorCode::NotInteger, run.column(start), fmt::format("{}", real));
  }
  value = static_cast<int>(whole);
  return true;
}

bool read_expression(Run& run, const char*& at, double& value) {
  return read_or_compute(run, at, value, &Terms::bracketed);
}

bool read_name(Run& run, const char*& at, std::string& name) {
  const char* start = at;
  name.clear();
  for (++at; *at != '>'; ++at) {
    if (is_end_of_line(*at))
      return run.fail(ErrorCode::BadCharacter, run.column(start), "< without >");
    if (is_blank(*at)) continue;
    const char c = *at;
    name += c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
  }
  ++at;
  if (name.empty() || name.size() > kMaxNameLength) {
    return run.fail(ErrorCode::TooManyNames, run.column(start),
                    fmt::format("a name has 1 to {} characters", kMaxNameLength));
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
