#include "gateway/interpreter/tnc155/tools.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "gateway/interpreter/tnc155/contour.hpp"
#include "gateway/interpreter/tnc155/machine_functions.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

const ToolData* find(const std::vector<ToolDefinition>& tools, int number) {
  const auto at = std::find_if(tools.begin(), tools.end(),
                               [&](const ToolDefinition& tool) { return tool.number == number; });
  return at == tools.end() ? nullptr : &at->data;
}

/// The plane that tools of this axis work in; those of U, V, W as their parallels.
Plane plane_of(Axis axis) {
  switch (axis) {
    case Axis::X:
    case Axis::U:
    case Axis::A:
      return Plane::YZ;
    case Axis::Y:
    case Axis::V:
    case Axis::B:
      return Plane::ZX;
    default:
      return Plane::XY;
  }
}

bool choose(Run& run, int number) {
  State& state = run.state;
  ActiveTool& tool = state.tool;
  if (number == 0) {
    tool.number = 0;
    tool.data = {};
    return true;
  }
  const ToolData* data = run.options.central_tool_file ? find(run.tools, number) : nullptr;
  if (data == nullptr) data = find(state.definitions, number);
  if (data == nullptr) data = find(run.tools, number);
  if (data == nullptr) return run.fail(ErrorCode::ToolDefMissing, fmt::format("tool {}", number));
  tool.number = number;
  tool.data = *data;
  return true;
}

}  // namespace

bool define_tool(Run& run, const Block& block) {
  State& state = run.state;
  if (!block.length.is_programmed() && !block.radius.is_programmed()) {
    run.events().on_tool({run.origin, block.target, true, {}, {}});
    return true;
  }
  if (block.target < 1 || block.target > kLastTool) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("tool {} is not 1 to {}", block.target, kLastTool));
  }
  const auto number = static_cast<std::uint8_t>(block.target);
  const ToolData data{run.length(block.length), run.length(block.radius)};
  auto at = std::find_if(state.definitions.begin(), state.definitions.end(),
                         [&](const ToolDefinition& tool) { return tool.number == number; });
  if (at == state.definitions.end()) at = state.definitions.insert(at, {number, {}});
  at->data = data;
  return true;
}

bool call_tool(Run& run, const Block& block) {
  State& state = run.state;
  const bool is_change = block.target != Block::kNone;
  const bool names_axis = block.axis.has_value() || block.is_fourth_axis;
  if (is_change || names_axis) end_contour(run, false);
  if (is_change && !choose(run, block.target)) return false;
  if (names_axis) {
    state.tool.axis = block.is_fourth_axis ? run.options.fourth_axis : *block.axis;
    state.tool.is_called = true;
    state.plane = plane_of(state.tool.axis);
    state.polar.is_current = false;
    state.last.exists = false;
  }
  if (is_change) {
    const ToolShape shape{Length::mm(state.tool.data.length), Length::mm(state.tool.data.radius)};
    run.events().on_tool({run.origin, state.tool.number, false, {}, shape});
  }
  return !block.spindle.is_programmed() || set_speed(run, run.number(block.spindle));
}

Result<void> load_tools(const Setup& setup, std::vector<ToolDefinition>& tools) {
  for (const ToolRecord& record : setup.tools) {
    if (record.number < 1 || record.number > kLastTool) {
      return fail(Errc::Unsupported, "tool {}: this control has tools 1 to {}", record.number,
                  kLastTool);
    }
    tools.push_back({static_cast<std::uint8_t>(record.number),
                     {record.length.raw(Axis::Z), record.radius.mm()}});
  }
  return {};
}

}  // namespace dripline::interpreter::tnc155
