#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/flow.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/tools.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"

namespace dripline::interpreter::tnc155 {

std::string parameter_name(std::int32_t parameter) {
  const std::int32_t first = parameter >= kFirstRetained ? kFirstRetained
                             : parameter >= kFirstLocal  ? kFirstLocal
                                                         : 0;
  return fmt::format("{}{}",
                     first == 0             ? "Q"
                     : first == kFirstLocal ? "QL"
                                            : "QR",
                     parameter - first);
}

}  // namespace dripline::interpreter::tnc155

namespace dripline::interpreter::tnc155::itnc {
namespace {

using language::Computed;
using language::MathFault;

constexpr double kLargest = 999'999'999.9999;

Computed arc_sine(double value) {
  if (!(std::fabs(value) <= 1)) return {0, MathFault::Undefined};
  return {std::asin(value) * (180 / Angle::kPi)};
}

Computed apply(FormulaFunction function, double a) {
  switch (function) {
    case FormulaFunction::Sqrt:
      return language::square_root(a);
    case FormulaFunction::Sin:
      return language::sine(a);
    case FormulaFunction::Cos:
      return language::cosine(a);
    case FormulaFunction::Tan:
      return language::tangent(a);
    case FormulaFunction::Asin:
      return arc_sine(a);
    case FormulaFunction::Acos: {
      const Computed sine = arc_sine(a);
      return {90 - sine.value, sine.fault};
    }
    case FormulaFunction::Atan:
      return {std::atan(a) * (180 / Angle::kPi)};
    case FormulaFunction::Sq:
      return {a * a};
    case FormulaFunction::Ln:
      return language::natural_logarithm(a);
    case FormulaFunction::Log:
      if (!(a > 0)) return {0, MathFault::LogArgument};
      return {std::log10(a)};
    case FormulaFunction::Exp:
      return language::exponential(a);
    case FormulaFunction::Neg:
      return {-a};
    case FormulaFunction::Int:
      return {std::trunc(a)};
    case FormulaFunction::Abs:
      return {std::fabs(a)};
    case FormulaFunction::Frac:
      return {a - std::trunc(a)};
    default:
      return {a < 0 ? -1.0 : 1.0};  // of 0: 1
  }
}

Computed apply(char op, double a, double b) {
  switch (op) {
    case '+':
      return {a + b};
    case '-':
      return {a - b};
    case '*':
      return {a * b};
    case '/':
      if (b == 0) return {0, MathFault::DivisionByZero};
      return {a / b};
    case '%':
      // Of what sign the rest of a negative number is, the manuals do not say.
      if (a < 0 || b <= 0) return {0, MathFault::Undefined};
      return {std::fmod(a, b)};
    case '^':
      if (a < 0 && b != std::trunc(b)) return {0, MathFault::PowerBase};
      if (a == 0 && b < 0) return {0, MathFault::DivisionByZero};
      return {std::pow(a, b)};
    case 'L':
      return {std::hypot(a, b)};
    default: {  // FN 13: the angle of the opposite and the adjacent side, 0 to 360
      Computed angle = language::arc_tangent(a, b);
      if (angle.value < 0) angle.value += 360;
      return angle;
    }
  }
}

/// Before a TOOL CALL of this run its tool is not known.
bool read_parameter(Run& run, std::int32_t parameter, double& value) {
  const State& state = run.state;
  const double unit = state.mm_per_unit();
  value = state.q[static_cast<std::size_t>(parameter)];
  if (!is_of_control(parameter)) {
    if (parameter >= kFirstRetained && !check_retained(run, parameter)) return false;
    if (state.start.is_searching) note_use(run, parameter);
    return true;
  }
  if (is_plane_angle(parameter)) return state.has_plane_angles || fail_plane_angle(run, parameter);
  if (parameter == kInchProgram) {
    value = state.units == Units::Inch ? 1 : 0;
    return true;
  }
  if (!state.tool.is_called) {
    return run.fail(ErrorCode::ToolCallMissing, fmt::format("Q{} is of the tool", parameter));
  }
  value = parameter == kToolRadius   ? state.tool.data.radius / unit
          : parameter == kToolLength ? state.tool.data.length / unit
                                     : static_cast<double>(state.tool.axis);
  return true;
}

}  // namespace

bool check_retained(Run& run, std::int32_t parameter) {
  if (run.state.known_retained.test(static_cast<std::size_t>(parameter - kFirstRetained)))
    return true;
  return run.fail(
      ErrorCode::NotSupported,
      fmt::format("{} keeps what an earlier program left: the setup has no such variable",
                  parameter_name(parameter)));
}

bool evaluate(Run& run, const Formula& formula, double& result) {
  constexpr std::size_t kMaxStack = 64;
  std::array<double, kMaxStack> stack{};
  std::size_t size = 0;
  for (const FormulaStep& step : formula) {
    Computed computed;
    switch (step.kind) {
      case FormulaStep::Kind::Number:
        computed.value = step.number;
        break;
      case FormulaStep::Kind::Parameter:
        if (!read_parameter(run, step.parameter, computed.value)) return false;
        break;
      case FormulaStep::Kind::Operator:
        size -= 2;
        computed = apply(step.op, stack[size], stack[size + 1]);
        break;
      case FormulaStep::Kind::Function:
        --size;
        computed = apply(step.function, stack[size]);
        break;
    }
    if (computed.fault != MathFault::None) {
      return run.fail(ErrorCode::ArithmeticalError, language::to_string(computed.fault));
    }
    if (!(std::fabs(computed.value) <= kLargest)) {
      return run.fail(ErrorCode::ArithmeticalError,
                      fmt::format("{} is beyond {}", computed.value, kLargest));
    }
    if (size == kMaxStack) return run.fail(ErrorCode::ArithmeticalError, "the formula is too deep");
    stack[size++] = computed.value;
  }
  result = stack[0];
  return true;
}

namespace {

bool set(Run& run, std::int32_t parameter, double value) {
  run.set_q(parameter, value);
  return true;
}

/// A start in the middle computes again what the program has computed, but for a value that
/// continues that of the run before.
bool note_in_search(Run& run, const Block& block) {
  if (!run.state.start.is_searching) return true;
  for (const FormulaStep& step : run.parts.itnc.formula) {
    const bool is_program =
        step.kind == FormulaStep::Kind::Parameter && !is_of_control(step.parameter);
    if (is_program) note_use(run, step.parameter);
  }
  return note_result(run, block);
}

/// The same of system data: of what the program itself has set before the block.
bool note_system_in_search(Run& run, const Block& block, bool is_rebuilt) {
  if (!run.state.start.is_searching) return true;
  if (is_rebuilt) return note_result(run, block);
  return run.fail(ErrorCode::ProgramStartUndefined,
                  fmt::format("a start after FN 18 has read into {} what the program had not set",
                              parameter_name(block.target)));
}

/// The control keeps values as binary numbers (IEEE 754; iTNC 530, User's Manual, programming notes
/// of Q parameters), in which 0.1 + 0.2 is not 0.3, and its manual warns of that before jumps: a
/// loop by 0.1 may go a pass beyond the limit that it names. Two values that a program means to be
/// different differ by more than this: its numbers have seven decimals.
bool differ_by_rounding(double a, double b) {
  constexpr double kLeast = 1e-9, kShare = 1e-14;
  return a != b &&
         std::fabs(a - b) <= std::max(kLeast, kShare * std::max(std::fabs(a), std::fabs(b)));
}

/// Once in a run: the first one names the place.
void warn_of_rounding(Run& run, int function, double a, double b) {
  if (std::exchange(run.state.has_rounded, true)) return;
  run.warn("TNC-NEARLY-EQUAL",
           fmt::format("FN {}: {} and {} differ by rounding alone and {} (option comparison)",
                       function, a, b,
                       run.options.compares_rounded
                           ? "are taken as equal; the control itself compares all digits"
                           : "are not equal to the control: a loop may make one pass more"));
}

/// IDX of an FN 18: a number, or the value of a Q parameter.
bool index_of_system(Run& run, int& index) {
  index = run.parts.itnc.ids[2];
  if (index != kIndexOfFormula) return true;
  constexpr double kLargestIndex = 99'999;
  double value = 0;
  if (!evaluate(run, run.parts.itnc.formula, value)) return false;
  if (!(value >= 0) || value > kLargestIndex || value != std::trunc(value)) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("FN 18: IDX is {}", value));
  }
  index = static_cast<int>(value);
  return true;
}

/// ID 50: length and radius of a tool in the table, without DL and DR of a TOOL CALL. Without an
/// index of the one that was called.
bool read_tool(Run& run, const Block& block, int field, int index) {
  const int number = index == 0 ? run.state.tool.number : index;
  constexpr ToolData kNoTool{};
  const ToolData* data = number == 0 ? &kNoTool : find_tool(run, number);
  if (data == nullptr) return run.fail(ErrorCode::ToolDefMissing, fmt::format("tool {}", number));
  return set(run, block.target,
             (field == 1 ? data->length : data->radius) / run.state.mm_per_unit());
}

/// ID 240: where the program has brought an axis, in machine coordinates.
bool read_machine_position(Run& run, const Block& block, Axis axis) {
  const State& state = run.state;
  if (run.tilted.is_on())
    return run.fail(ErrorCode::TiltFailed, "FN 18: SYSREAD ID240 in a tilted plane or under M128");
  if (state.compensation > Compensation::Off) {
    return run.fail(ErrorCode::NotSupported, "FN 18: SYSREAD ID240 with RL or RR in force");
  }
  const double length = state.tool.data.length;
  if (axis == state.tool.axis && length != 0) {
    return run.fail(
        ErrorCode::NotSupported,
        fmt::format("FN 18: SYSREAD ID240: whether {} has the tool's length of {} mm in "
                    "it is not known; TOOL CALL 0 before it",
                    letter(axis), length));
  }
  return set(run, block.target, state.machine.raw(axis) / state.mm_per_unit());
}

}  // namespace

bool assign(Run& run, const Block& block) {
  double value = 0;
  return note_in_search(run, block) && evaluate(run, run.parts.itnc.formula, value) &&
         set(run, block.target, value);
}

bool compare(Run& run, const Block& block) {
  double a = 0, b = 0;
  const ItncWords& words = run.parts.itnc;
  if (!evaluate(run, words.formula, a) || !evaluate(run, words.second, b)) return false;
  if (differ_by_rounding(a, b)) {
    warn_of_rounding(run, block.function, a, b);
    if (run.options.compares_rounded) b = a;
  }
  constexpr int kEqual = 9, kNotEqual = 10, kGreater = 11;
  const bool is_true = block.function == kEqual      ? a == b
                       : block.function == kNotEqual ? a != b
                       : block.function == kGreater  ? a > b
                                                     : a < b;
  return !is_true || jump_to_label(run, block.target);
}

bool raise_error(Run& run, const Block& block) {
  return run.fail_as(ErrorCode::ProgramError, fmt::format("FN 14: ERROR = {}", block.target));
}

/// iTNC 530, User's Manual: FN 18, table of system data. What is not here is an alarm.
bool read_system(Run& run, const Block& block) {
  const State& state = run.state;
  const auto& ids = run.parts.itnc.ids;
  const int id = ids[0], number = ids[1];
  int place = 0;
  if (!index_of_system(run, place)) return false;
  const double unit = state.mm_per_unit();
  const bool is_moved = place >= 1 && place <= 3 && state.machine.has(static_cast<Axis>(place - 1));
  const bool is_position = id == 270 || id == 240;
  if (is_position && !check_place_is_known(run)) return false;
  const bool is_of_table = id == 50 && place > 0;
  const bool is_rebuilt =
      id == 220 || is_of_table || (is_position ? is_moved : state.tool.is_called);
  if (!note_system_in_search(run, block, is_rebuilt)) return false;
  if (place == 0 && (id == 20 || id == 60)) {
    if (number == 1) return set(run, block.target, state.tool.number);
    const bool is_axis = number == (id == 20 ? 3 : 2);
    if (is_axis && state.tool.is_called) {
      return set(run, block.target, static_cast<double>(state.tool.axis));
    }
    if (number == (id == 20 ? 4 : 3)) return set(run, block.target, state.spindle.speed);
  }
  if (id == 50 && (number == 1 || number == 2) && (is_of_table || state.tool.is_called)) {
    return read_tool(run, block, number, place);
  }
  if (id == 220 && number == 2 && place >= 1 && place <= 3) {
    return set(run, block.target,
               state.transformation.shift[static_cast<std::size_t>(place - 1)] / unit);
  }
  if (id == 270 && number == 1 && place >= 1 && place <= 3) {
    if (!refuse_before_positioning(run, "FN 18 of the position")) return false;
    return set(run, block.target, state.nominal[static_cast<std::size_t>(place - 1)] / unit);
  }
  if (id == 240 && number == 1 && place >= 1 && place <= 3) {
    return read_machine_position(run, block, static_cast<Axis>(place - 1));
  }
  return run.fail(ErrorCode::NotSupported,
                  fmt::format("FN 18: SYSREAD ID{} NR{} IDX{}", id, number, place));
}

}  // namespace dripline::interpreter::tnc155::itnc
