#include "gateway/interpreter/centurion/machine_functions.hpp"

#include <algorithm>

#include "gateway/interpreter/centurion/reference_points.hpp"

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
    const double most = most_revolutions(run);
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

bool has_m(const Run& run, MAction action) {
  const auto* begin = run.block.m.data();
  return std::any_of(begin, begin + run.block.parts.m_count,
                     [action](std::uint8_t code) { return m_row(code).action == action; });
}

void use_offset(Run& run, int offset) {
  run.state.tool.offset = offset;
  run.state.tool.has_no_length = false;
  refresh_tool(run);
}

std::optional<int> offset_or_none(int offset) {
  return offset >= 0 ? std::optional<int>(offset) : std::nullopt;
}

/// X goes to the tool change position, the machine is told, the operator is asked (spec 12.2).
void change_tool(Run& run) {
  ModalState& state = run.state;
  go_to_tool_change(run);
  state.tool.active = state.tool.pending;
  if (state.tool.pending_offset >= 0) use_offset(run, state.tool.pending_offset);
  run.events().on_tool(
      {run.origin, state.tool.active, false, offset_or_none(state.tool.pending_offset)});
  show_comment(run);
  run.events().on_stop({run.origin, StopKind::ToolChange});
}

void apply_m(Run& run, const MRow& row) {
  switch (row.action) {
    case MAction::Strobe:
      run.events().on_miscellaneous({run.origin, row.code});
      return;
    case MAction::SpindleRange:
      run.parameters.byte(kSpindleRange) = static_cast<std::uint8_t>(row.code - 40);
      run.events().on_miscellaneous({run.origin, row.code});
      return;
    case MAction::SpindleClockwise:
      return spindle_to(run, SpindleState::Clockwise);
    case MAction::SpindleCounterClockwise:
      return spindle_to(run, SpindleState::CounterClockwise);
    case MAction::SpindleOff:
      return spindle_to(run, SpindleState::Off);
    case MAction::ToolChange:
      return change_tool(run);
    case MAction::FloodOn:
      run.state.coolant.flood = true;
      return emit_coolant(run);
    case MAction::CoolantOff:
      run.state.coolant.flood = run.state.coolant.mist = false;
      return emit_coolant(run);
    case MAction::ProgramStop:
      show_comment(run);
      run.events().on_stop({run.origin, StopKind::Program});
      return;
    case MAction::OptionalStop:
      if (!run.options.optional_stop) return;
      show_comment(run);
      run.events().on_stop({run.origin, StopKind::Optional});
      return;
    case MAction::End:
    case MAction::EndAllOff:
    case MAction::Call:
      return;  // flow.cpp
  }
}

}  // namespace

bool apply_machine_functions(Run& run, MTiming timing) {
  Block& block = run.block;
  std::sort(block.m.begin(), block.m.begin() + block.parts.m_count);
  for (std::uint8_t i = 0; i < block.parts.m_count; ++i) {
    const MRow& row = m_row(block.m[i]);
    if (row.timing == timing) apply_m(run, row);
  }
  return true;
}

void apply_tool(Run& run) {
  ToolModes& tool = run.state.tool;
  tool.pending = *run.block.parts.tool;
  tool.pending_offset = run.block.parts.tool_offset;
  if (has_m(run, MAction::ToolChange)) return;  // M6 of this block shows it
  const bool is_preselection = tool.pending != tool.active;
  if (!is_preselection) {
    if (tool.pending_offset < 0) return;
    use_offset(run, tool.pending_offset);
  }
  run.events().on_tool(
      {run.origin, tool.pending, is_preselection, offset_or_none(tool.pending_offset)});
}

void refresh_tool(Run& run) {
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
  if (has_m(run, MAction::SpindleClockwise) || has_m(run, MAction::SpindleCounterClockwise)) return;
  emit_spindle(run);
}

double most_revolutions(const Run& run) {
  const auto& ranges = run.options.spindle_ranges;
  const std::size_t range = run.parameters.byte(kSpindleRange);
  return range >= 1 && range <= ranges.size() ? ranges[range - 1] : kNoLimit;
}

void spindle_to(Run& run, SpindleState state) {
  run.state.spindle.state = state;
  emit_spindle(run);
}

void all_off(Run& run) {
  if (run.state.spindle.state != SpindleState::Off) spindle_to(run, SpindleState::Off);
  if (run.state.coolant.flood || run.state.coolant.mist) {
    run.state.coolant.flood = run.state.coolant.mist = false;
    emit_coolant(run);
  }
}

void show_comment(Run& run) {
  const TextRange comment = run.block.parts.comment;
  if (comment.empty()) return;
  run.events().on_message({run.origin, std::string_view(run.text.begin() + comment.begin,
                                                        comment.end - comment.begin)});
}

}  // namespace dripline::interpreter::centurion
