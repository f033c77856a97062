#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "gateway/interpreter/dialects/centurion/codes/reference_points.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/memory/pins.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr double kNoLimit = 9999;

void emit_spindle(Run& run) {
  const SpindleModes& modes = run.state.spindle;
  Spindle event;
  event.origin = run.origin;
  event.state = modes.state;
  event.revolutions_per_minute = modes.state == SpindleState::Off ? 0 : modes.revolutions;
  if (run.state.modes.is_surface_speed && modes.state != SpindleState::Off) {
    event.surface_speed = run.state.units == Units::Inch ? Length::inch(12 * modes.surface)
                                                         : Length::mm(1000 * modes.surface);
    const double most = max_revolutions(run);
    if (modes.limit > 0 || most < kNoLimit) {
      event.max_revolutions = modes.limit > 0 ? std::min(modes.limit, most) : most;
    }
  }
  run.events().on_spindle(event);
}

void emit_coolant(Run& run) {
  run.state.coolant.origin = run.origin;
  run.events().on_coolant(run.state.coolant);
}

bool has_m(const Run& run, std::uint8_t code) {
  const auto* begin = run.block.m.data();
  const auto* end = begin + run.block.parts.m_count;
  return std::find(begin, end, code) != end;
}

void use_offset(Run& run, int offset) {
  run.state.tool.offset = offset;
  run.state.tool.has_no_length = false;
  refresh_tool(run);
}

std::optional<int> offset_or_none(int offset) {
  return offset >= 0 ? std::optional<int>(offset) : std::nullopt;
}

void take_pending_tool(Run& run) {
  ToolModes& tool = run.state.tool;
  tool.active = tool.pending;
  if (tool.pending_offset >= 0) use_offset(run, tool.pending_offset);
  run.events().on_tool({run.origin, tool.active, false, offset_or_none(tool.pending_offset)});
}

/// A changer with pockets finds no tool outside of them. T00 puts away the tool in the spindle.
bool check_pocket(Run& run) {
  const int pockets = static_cast<int>(run.parameters[kAtcPockets]);
  const int tool = run.state.tool.pending;
  if (pockets == 0 || tool == 0 || run.options.pockets[static_cast<std::size_t>(tool)] != 0)
    return true;
  return run.fail(ErrorCode::ToolNotFound, 0,
                  fmt::format("T{:02} is in none of {} pockets", tool, pockets));
}

/// X goes to the tool change position, the machine is signaled, and without a changer the program
/// waits for the operator (manual: M6). The spindle is locked until then; the machine decides what
/// that means while it rotates.
bool change_tool(Run& run) {
  constexpr double kPulseMs = 150;
  if (!check_pocket(run)) return false;
  if (!go_to_tool_change(run)) return false;
  if (run.options.tool_change_stops_spindle && run.state.spindle.state != SpindleState::Off)
    spindle_to(run, SpindleState::Off);
  if (run.options.tool_change_pin)
    pulse_output(run, *output_of_pin(*run.options.tool_change_pin), true, kPulseMs);
  take_pending_tool(run);
  show_comment(run);
  run.loops.note_progress();
  if (!has_tool_changer(run)) run.events().on_stop({run.origin, StopKind::ToolChange});
  return true;
}

constexpr int kWaitChannelInput = 6;

/// Strobes the code, then waits for the input; with the answer only the rest is done.
bool strobe_and_wait(Run& run, const MRow& row, int pin) {
  if (run.answers.empty()) strobe(run, row);
  return wait_for_input(run, pin);
}

/// The number of the pin in codes that come in tens: M20 and M60 mean the first.
int pin_number(const MRow& row) {
  return row.code % 10 + 1;
}

bool stop(Run& run, StopKind kind) {
  show_comment(run);
  run.loops.note_progress();
  run.events().on_stop({run.origin, kind});
  return true;
}

void set_flood(Run& run, bool on) {
  run.state.wants_flood = on;
  if (on && run.options.interlocks_coolant && run.state.spindle.state == SpindleState::Off) return;
  run.state.coolant.flood = on;
  if (!on) run.state.coolant.mist = false;
  emit_coolant(run);
}

/// With the interlock, the coolant of M8 follows the spindle.
void follow_spindle(Run& run) {
  const bool is_running = run.state.spindle.state != SpindleState::Off;
  if (!run.options.interlocks_coolant ||
      run.state.coolant.flood == (is_running && run.state.wants_flood))
    return;
  run.state.coolant.flood = is_running;
  emit_coolant(run);
}

MTiming timing_of(const Run& run, const MRow& row) {
  if (run.options.post_m.empty() || row.timing == MTiming::Flow) return row.timing;
  const auto& post = run.options.post_m;
  const bool is_post = std::find(post.begin(), post.end(), int{row.code}) != post.end();
  return is_post ? MTiming::PostMove : row.timing;
}

}  // namespace

bool strobe(Run& run, const MRow& row) {
  run.events().on_miscellaneous({run.origin, row.code});
  return true;
}

bool stop_program(Run& run, const MRow&) {
  return stop(run, StopKind::Program);
}

bool stop_if_switched_on(Run& run, const MRow&) {
  return !run.options.optional_stop || stop(run, StopKind::Optional);
}

bool start_spindle(Run& run, const MRow& row) {
  spindle_to(run, row.code == 3 ? SpindleState::Clockwise : SpindleState::Counterclockwise);
  return true;
}

bool stop_spindle(Run& run, const MRow&) {
  spindle_to(run, SpindleState::Off);
  return true;
}

bool start_coolant(Run& run, const MRow&) {
  set_flood(run, true);
  return true;
}

bool stop_coolant(Run& run, const MRow&) {
  set_flood(run, false);
  return true;
}

bool change_tool_or_call(Run& run, const MRow&) {
  const std::uint16_t program = tool_change_program(run);
  return program != 0 ? request_macro(run, program, MacroCaller::M6, 0) : change_tool(run);
}

bool wait_for_x_input(Run& run, const MRow& row) {
  return strobe_and_wait(run, row, input_pin(Axis::X, pin_number(row)));
}

bool wait_for_channel(Run& run, const MRow& row) {
  return strobe_and_wait(run, row, input_pin(Axis::Z, kWaitChannelInput));
}

bool set_x_output(Run& run, const MRow& row) {
  remember_output(run, {Axis::X, pin_number(row)}, row.code < 70);
  return strobe(run, row);
}

bool apply_machine_functions(Run& run, MTiming timing) {
  Block& block = run.block;
  std::sort(block.m.begin(), block.m.begin() + block.parts.m_count);
  for (std::uint8_t& next = block.parts.m_next; next < block.parts.m_count; ++next) {
    const MRow& row = m_row(block.m[next]);
    if (timing_of(run, row) != timing || row.apply == nullptr) continue;
    if (!row.apply(run, row)) return false;
  }
  return true;
}

void finish_tool_change(Run& run) {
  const ToolModes& tool = run.state.tool;
  const bool has_offset = tool.pending_offset >= 0 && tool.pending_offset != tool.offset;
  if (tool.active != tool.pending || has_offset) take_pending_tool(run);
}

void apply_tool(Run& run) {
  ToolModes& tool = run.state.tool;
  tool.pending = *run.block.parts.tool;
  tool.pending_offset = run.block.parts.tool_offset;
  if (has_m(run, 6)) return;  // M6 of this block reports it
  const bool is_preselection = tool.pending != tool.active;
  if (!is_preselection) {
    if (tool.pending_offset < 0) return;
    use_offset(run, tool.pending_offset);
  }
  run.events().on_tool(
      {run.origin, tool.pending, is_preselection, offset_or_none(tool.pending_offset)});
}

void refresh_tool(Run& run) {
  run.state.nose_is_stale = true;
  const int offset = run.state.tool.offset;
  run.parameters[261] = run.parameters.tool(offset, ToolField::Radius);
  run.parameters[262] = run.parameters.tool(offset, ToolField::Type);
}

void show_speed_change(Run& run, const SpindleModes& before, bool was_surface_speed) {
  const SpindleModes& now = run.state.spindle;
  if (now.state == SpindleState::Off) return;
  const bool is_surface_speed = run.state.modes.is_surface_speed;
  const bool changed =
      is_surface_speed != was_surface_speed ||
      (is_surface_speed ? now.surface != before.surface || now.limit != before.limit
                        : now.revolutions != before.revolutions);
  if (!changed) return;
  if (has_m(run, 3) || has_m(run, 4)) return;
  emit_spindle(run);
}

void apply_spindle_range(Run& run) {
  for (std::uint8_t i = 0; i < run.block.parts.m_count; ++i) {
    const std::uint8_t code = run.block.m[i];
    if (code < 41 || code > 43) continue;
    run.start.note_byte_set(kSpindleRange);
    run.parameters.byte(kSpindleRange) = static_cast<std::uint8_t>(code - 40);
  }
}

double max_revolutions(const Run& run) {
  const auto& ranges = run.options.spindle_ranges;
  const std::size_t range = run.parameters.byte(kSpindleRange);
  return range >= 1 && range <= ranges.size() ? ranges[range - 1] : kNoLimit;
}

void spindle_to(Run& run, SpindleState state) {
  run.state.spindle.state = state;
  emit_spindle(run);
  follow_spindle(run);
}

void all_off(Run& run) {
  if (run.state.spindle.state != SpindleState::Off) spindle_to(run, SpindleState::Off);
  run.state.wants_flood = false;
  if (run.state.coolant.flood || run.state.coolant.mist) {
    run.state.coolant.flood = run.state.coolant.mist = false;
    emit_coolant(run);
  }
}

bool has_tool_changer(const Run& run) {
  return run.options.has_tool_changer || run.parameters[kAtcPockets] > 0;
}

void show_machine_state(Run& run) {
  if (run.state.spindle.state != SpindleState::Off) emit_spindle(run);
  if (run.state.coolant.flood) emit_coolant(run);
  if (run.state.modes.path == PathMode::Tapping)
    run.events().on_override_inhibit(override_inhibit(run));
}

OverrideInhibit override_inhibit(const Run& run) {
  const bool is_tapping_mode = run.state.modes.path == PathMode::Tapping;
  return {.origin = run.origin,
          .feed_override = is_tapping_mode,
          .spindle_override = is_tapping_mode,
          .single_block = is_tapping_mode,
          .hold = is_tapping_mode ? FeedHoldInhibit::Later : FeedHoldInhibit::AtOnce,
          .is_tapping = false};
}

void show_comment(Run& run) {
  const TextRange comment = run.block.parts.comment;
  if (comment.empty()) return;
  run.events().on_message({run.origin, std::string_view(run.text.begin() + comment.begin,
                                                        comment.end - comment.begin)});
}

}  // namespace dripline::interpreter::centurion
