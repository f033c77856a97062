#include "gateway/interpreter/dialects/centurion/codes/status_window.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// A cycle that follows a pattern lasts for many blocks, all others for their own.
std::string_view cycle_of(const Run& run) {
  if (run.state.pattern.phase != PatternPhase::None)
    return g_row(g_row_index(run.state.pattern.code)).name;
  if (run.block.parts.thread_code != 0) return g_row(g_row_index(run.block.parts.thread_code)).name;
  const std::uint8_t row = run.block.parts.axis_row;
  return row != kNoRow && g_row(row).kind == GKind::Cycle ? g_row(row).name : std::string_view();
}

}  // namespace

ActiveModes active_modes(const Run& run) {
  const ModalState& state = run.state;
  const auto tool = [&](ToolField field) {
    return run.length(run.parameters.tool(state.tool.offset, field));
  };
  ActiveModes modes;
  modes.units = state.units;
  modes.is_incremental = state.modes.is_incremental;
  modes.compensation = static_cast<CompensationSide>(state.modes.compensation);
  modes.work_system = static_cast<std::uint16_t>(540 + 10 * state.modes.work_system);
  if (!state.tool.has_no_length) {
    modes.tool_length_x = tool(ToolField::LengthX);
    modes.tool_length_z = tool(ToolField::LengthZ);
  }
  modes.tool_radius = tool(ToolField::Radius);
  modes.feed = run.active_feed();
  modes.cycle = cycle_of(run);
  return modes;
}

}  // namespace dripline::interpreter::centurion
