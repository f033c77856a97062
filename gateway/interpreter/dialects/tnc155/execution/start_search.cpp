#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

/// Positions are the same within the control's resolution.
constexpr double kResolution = 0.001;

std::string block_text(std::int32_t number) {
  return number < 0 ? "a block without number" : fmt::format("block {}", number);
}

/// The number of its label, or its name in quotes: the run has met the label when it went there.
std::string label_text(const State& state, const LabelFrame& frame) {
  if (frame.label != static_cast<std::uint32_t>(kNameLabel)) return fmt::format("{}", frame.label);
  for (const LabelPlace& label : state.known_labels) {
    const bool is_it = label.program == frame.call.program && label.at.offset == frame.from;
    if (is_it) return fmt::format("\"{}\"", label.name);
  }
  return "with a name";
}

/// Why the state at this block cannot be rebuilt, one text a reason.
std::vector<std::string> refusals(const Run& run, std::int32_t returning) {
  const State& state = run.state;
  std::vector<std::string> reasons;
  for (const LabelFrame& frame : state.labels) {
    if (state.start.pass != 0) break;
    reasons.push_back(fmt::format("repeats and return address of LBL {}, which line {} calls",
                                  label_text(state, frame), frame.call.line));
  }
  if (returning >= 0) {
    reasons.push_back(fmt::format("how often block {} leads back over it", returning));
  }
  if (run.tilted.is_on()) reasons.push_back("the tilted plane, or M128: start before it");
  if (is_contour_open(state)) {
    reasons.push_back(
        fmt::format("the contour with radius compensation or the corner from {} on: "
                    "start there",
                    block_text(state.start.contour_block)));
  }
  if (!state.cycle.is_complete) {
    reasons.push_back(fmt::format("CYCL DEF {}, which it is a part of: start at its first block",
                                  state.cycle.defining));
  }
  if (run.options.random_changer && state.start.has_changed_tool) {
    reasons.push_back("which pockets the tools are in: the random changer has changed tools");
  }
  return reasons;
}

std::string join(const std::vector<std::string>& reasons) {
  std::string text;
  for (const std::string& reason : reasons) {
    if (!text.empty()) text += "; ";
    text += reason;
  }
  return text;
}

void add_axes(std::string& text, const AxisValues& values) {
  for (const Axis axis : kAllAxes) {
    const double value = values[static_cast<std::size_t>(axis)];
    if (value != 0) text += fmt::format(" {}{:+.3f}", letter(axis), value);
  }
}

/// What is kept of repeats and subprograms, as by the arrow keys; a start without a pass has none.
void add_labels(std::string& text, const State& state) {
  for (const LabelFrame& frame : state.labels) {
    if (frame.is_repeat) {
      text += fmt::format(", LBL {} {} more times", label_text(state, frame), frame.left);
    } else {
      text += fmt::format(", LBL {} returns to line {}", label_text(state, frame), frame.back.line);
    }
  }
}

void add_transformation(std::string& text, const Transformation& now) {
  std::string shift;
  add_axes(shift, now.shift);
  if (!shift.empty()) text += ", datum shift" + shift;
  for (std::size_t i = 0; i < now.mirrored.size(); ++i) {
    if (now.mirrored[i]) text += fmt::format(", mirror {}", letter(kAllAxes[i]));
  }
  if (now.rotation != 0) text += fmt::format(", rotation {:+.3f}", now.rotation);
  if (now.scale != 1) text += fmt::format(", scale {:.6f}", now.scale);
}

/// What is in force, for the operator to compare with the machine.
std::string description(const Run& run, std::int32_t number, const Position& expected) {
  const State& state = run.state;
  std::string text = fmt::format("start at block {}", number);
  if (state.start.pass != 0) text += fmt::format(", pass {}", state.start.pass);
  text += ": ";
  if (state.tool.number != 0) {
    text += fmt::format("tool {} L{:+.3f} R{:+.3f}", state.tool.number, state.tool.data.length,
                        state.tool.data.radius);
  } else {
    text += "no tool";
  }
  constexpr std::string_view kSpindle[] = {"M05", "M03", "M04", "oriented"};
  text += fmt::format(", S {:.0f} {}", state.spindle.speed,
                      kSpindle[static_cast<std::size_t>(state.spindle.state)]);
  if (state.coolant.flood) text += ", coolant on";
  add_transformation(text, state.transformation);
  if (state.cycle.machining.number != 0) {
    text += fmt::format(", cycle {}", state.cycle.machining.number);
  }
  add_labels(text, state);
  for (std::size_t code = 0; code < state.start.codes.size(); ++code) {
    if (state.start.codes.test(code)) text += fmt::format(", M{:02} not given out", code);
  }
  std::string program, machine;
  add_axes(program, values_of(expected));
  add_axes(machine, values_of(state.start.actual));
  return text + fmt::format("; the program is at{}, the machine at{} (machine coordinates, mm)",
                            program.empty() ? " 0" : program, machine.empty() ? " 0" : machine);
}

/// The machine is where it was stopped; what joins a move to the one before it is lost.
void stand_at_start(Run& run) {
  State& state = run.state;
  state.machine = state.start.actual;
  state.machine.unmark_all();
  state.stand_at(state.transformation.to_program(values_of(state.machine)));
  state.last = LastMove{};
  state.polar = PolarData{};
  state.blend = Blend{};
  state.has_positioned = false;
  state.is_restart = true;
  ++run.frame_changes;
  run.reset_stages();
}

void announce(Run& run, const std::string& text) {
  const State& state = run.state;
  run.events().on_message({run.origin, text});
  if (state.tool.number != 0) {
    const ToolShape shape{Length::mm(state.tool.data.length), Length::mm(state.tool.data.radius)};
    run.events().on_tool({run.origin, state.tool.number, false, {}, shape});
  }
  stop(run, StopKind::Operator);
  if (state.spindle.state != SpindleState::Off) turn_spindle(run, state.spindle.state);
  if (state.coolant.flood) run.events().on_coolant({run.origin, true, false});
}

}  // namespace

bool is_contour_open(const State& state) {
  return state.compensation > Compensation::Off || state.is_parallel || state.joins ||
         state.blend.kind != BlendKind::None;
}

void StartGate::on_tool(const ToolChange& event) {
  if (is_open()) return out().on_tool(event);
  start_->has_changed_tool |= !event.is_preselection;
}

void StartGate::on_miscellaneous(const Miscellaneous& event) {
  if (is_open()) return out().on_miscellaneous(event);
  const auto code = static_cast<std::size_t>(event.code);
  if (code < start_->codes.size()) start_->codes.set(code);
}

bool begin_at_block(Run& run, std::int32_t number, std::int32_t returning) {
  State& state = run.state;
  if (const auto reasons = refusals(run, returning); !reasons.empty()) {
    return run.fail(ErrorCode::ProgramStartUndefined,
                    fmt::format("a start at block {} would lose {}", number, join(reasons)));
  }
  state.start.expected = state.uses_stages ? run.compensator.sent() : state.machine;
  const std::string text = description(run, number, state.start.expected);
  stand_at_start(run);
  state.start.is_searching = false;
  announce(run, text);
  return true;
}

void note_contour_start(Run& run, std::int32_t number) {
  StartState& start = run.state.start;
  const bool is_open = is_contour_open(run.state);
  if (is_open && !start.is_in_contour) start.contour_block = number;
  start.is_in_contour = is_open;
}

namespace {

void insert(std::vector<std::int32_t>& parameters, std::int32_t parameter) {
  const auto at = std::ranges::lower_bound(parameters, parameter);
  if (at == parameters.end() || *at != parameter) parameters.insert(at, parameter);
}

}  // namespace

void note_use(Run& run, std::int32_t parameter) {
  StartState& start = run.state.start;
  if (!std::ranges::binary_search(start.assigned, parameter)) insert(start.carried, parameter);
}

bool note_computation(Run& run, const Block& block) {
  for (const Value* operand : {&block.first, &block.second}) {
    if (operand->is_q()) note_use(run, operand->number);
  }
  return note_result(run, block);
}

bool note_result(Run& run, const Block& block) {
  return note_definition(run, block, block.target);
}

bool note_definition(Run& run, const Block& block, std::int32_t parameter) {
  StartState& start = run.state.start;
  if (!start.is_searching) return true;
  if (std::ranges::binary_search(start.carried, parameter)) {
    return run.fail(ErrorCode::ProgramStartUndefined,
                    fmt::format("a start after {} would lose Q{}, whose value continues that of "
                                "the run before",
                                block_text(block.number), parameter));
  }
  insert(start.assigned, parameter);
  return true;
}

namespace {

/// All axes but those in `named` must be where the program has them. `why`: ahead of the reason.
bool check_positions(Run& run, AxisMask named, std::string_view why) {
  const StartState& start = run.state.start;
  std::string wrong;
  for (const Axis axis : kAllAxes) {
    const double expected = start.expected.raw(axis);
    const double actual = start.actual.raw(axis);
    if ((named & bit(axis)) != 0 || std::fabs(expected - actual) <= kResolution) continue;
    wrong += fmt::format("{}{} is at {:.3f} and the program has it at {:.3f} here",
                         wrong.empty() ? "" : ", ", letter(axis), actual, expected);
  }
  if (wrong.empty()) return true;
  return run.fail(
      ErrorCode::ProgramStartUndefined,
      fmt::format("{}{} (machine coordinates): start at a block that positions it", why, wrong));
}

}  // namespace

bool check_start(Run& run, const Block& block, const Target& target, bool is_arc) {
  State& state = run.state;
  if (state.has_positioned) [[likely]]
    return true;
  const ProgramStart rule = state.is_restart ? ProgramStart::Complete : run.options.program_start;
  bool is_incremental = block.is_radius_incremental || block.is_angle_incremental;
  for (const Coordinate& word : block.words()) is_incremental |= word.is_incremental;
  const bool has_one = (target.named & (target.named - 1)) == 0;
  if ((rule != ProgramStart::Any && is_incremental) ||
      (rule == ProgramStart::Complete && has_one)) {
    return run.fail(
        ErrorCode::ProgramStartUndefined,
        fmt::format("the first positioning block{} {}", state.is_restart ? " after GOTO" : "",
                    is_incremental ? "is incremental" : "has one coordinate"));
  }
  if (state.is_restart) {
    // A corner is between this move and the next one, an arc about its center: from another place
    // they would be others. An approach may come from anywhere.
    const bool has_corner = run.blend_follows && block.compensation <= Compensation::Off;
    const AxisMask may_move = is_arc || has_corner ? AxisMask{0} : target.named;
    if (!check_positions(run, may_move,
                         has_corner ? "RND or a chamfer after the first positioning block: " : ""))
      return false;
  }
  state.has_positioned = true;
  state.is_restart = false;
  return true;
}

PlaneVector expected_in_plane(const State& state) {
  const PlaneAxes axes = axes_of(state.plane);
  const AxisValues at = state.transformation.to_program(values_of(state.start.expected));
  return {at[static_cast<std::size_t>(axes.first)], at[static_cast<std::size_t>(axes.second)]};
}

bool refuse_before_positioning(Run& run, std::string_view what) {
  if (!run.state.is_restart) return true;
  return run.fail(ErrorCode::ProgramStartUndefined,
                  fmt::format("{} after GOTO, before the first positioning block", what));
}

}  // namespace dripline::interpreter::tnc155
