#include "gateway/interpreter/dialects/tnc155/execution/tools.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <limits>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/ahead_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/changer.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/word_check.hpp"

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

/// Where the control looks first: its tool file, then what the run has defined.
const ToolData* find_known(const Run& run, int number) {
  const ToolData* data = run.options.central_tool_file ? find(run.tools, number) : nullptr;
  return data != nullptr ? data : find(run.state.definitions, number);
}

/// As the tool defined last.
void keep_definition(State& state, const ToolDefinition& tool) {
  std::erase_if(state.definitions,
                [&](const ToolDefinition& known) { return known.number == tool.number; });
  state.definitions.push_back(tool);
}

/// TOOL DEF further on in the text, with what its Q parameters hold now.
void take_definition_ahead(Run& run, int number) {
  const auto& ahead = run.definition_ahead;
  if (!ahead || ahead->block.target != number) return;
  const double unit = mm_per_unit(ahead->units);
  const ToolData data{run.number(ahead->block.length) * unit,
                      run.number(ahead->block.radius) * unit};
  keep_definition(run.state, {static_cast<std::uint16_t>(number), data});
}

/// Blockwise transfer keeps no blocks: only the tool defined last is there, but for the tool file.
bool refuse_in_transfer(Run& run, int number) {
  const auto& definitions = run.state.definitions;
  if (!run.options.blockwise_restrictions || run.options.central_tool_file || definitions.empty() ||
      definitions.back().number == number) {
    return true;
  }
  return run.fail(
      ErrorCode::NotInBlockwiseTransfer,
      fmt::format("TOOL CALL {}, the tool defined last is {}", number, definitions.back().number));
}

bool choose(Run& run, int number) {
  ActiveTool& tool = run.state.tool;
  run.is_length_doubtful = false;
  if (number == 0) {
    tool.number = 0;
    tool.data = {};
    return true;
  }
  if (!refuse_in_transfer(run, number)) return false;
  if (find_known(run, number) == nullptr) take_definition_ahead(run, number);
  const ToolData* data = find_tool(run, number);
  if (data == nullptr) return run.fail(ErrorCode::ToolDefMissing, fmt::format("tool {}", number));
  tool.number = number;
  tool.data = *data;
  tool.data.length += run.length(run.parts.itnc.delta_length);
  tool.data.radius += run.length(run.parts.itnc.delta_radius);
  if (run.options.is_itnc && tool.data.radius < 0) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("DR makes the radius {}", tool.data.radius));
  }
  return true;
}

}  // namespace

const ToolData* find_tool(const Run& run, int number) {
  const ToolData* data = find_known(run, number);
  return data != nullptr ? data : find(run.tools, number);  // what the setup has besides
}

bool define_tool(Run& run, const Block& block) {
  State& state = run.state;
  if (!block.length.is_programmed() && !block.radius.is_programmed()) {
    run.events().on_tool({run.origin, block.target, true, {}, {}});
    return true;
  }
  const int last_tool = run.options.is_itnc ? kLastItncTool : kLastTool;
  if (block.target < 1 || block.target > last_tool) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("tool {} is not 1 to {}", block.target, last_tool));
  }
  const auto number = static_cast<std::uint16_t>(block.target);
  keep_definition(state, {number, {run.length(block.length), run.length(block.radius)}});
  return true;
}

std::uint64_t reach_of_definition(const Run& run, const Block& block) {
  if (block.kind != BlockKind::ToolCall || block.target <= 0 ||
      run.options.blockwise_restrictions || run.options.is_itnc ||
      find_known(run, block.target) != nullptr) {
    return 0;
  }
  if (find(run.tools, block.target) == nullptr) return std::numeric_limits<std::uint64_t>::max();
  return run.options.checks_calls ? AheadSearch::kMaxBlocks : 0;
}

bool call_tool(Run& run, const Block& block) {
  State& state = run.state;
  const bool is_change = block.target != Block::kNone;
  const bool names_axis = block.axis.has_value() || block.is_fourth_axis;
  if (block.axis && !run.options.is_itnc && !check_axis(run, *block.axis)) return false;
  if (is_change || names_axis) {
    // Tool 0 has no radius: the travel to the tool change position is not compensated (manual: TOOL
    // CALL 0).
    state.needs_side = block.target != 0 && (state.is_compensating() || state.needs_side);
    end_contour(run, false);
  }
  if (is_change && !(choose(run, block.target) && change_tool(run, block.target))) return false;
  if (names_axis) {
    state.tool.axis = block.is_fourth_axis ? run.options.fourth_axis : *block.axis;
    state.tool.is_called = true;
    const Plane plane = plane_of(state.tool.axis);
    if (plane != state.plane) ++run.frame_changes;
    state.plane = plane;
    state.polar.is_current = false;
    state.last.exists = false;
  }
  if (is_change) {
    const ToolShape shape{Length::mm(state.tool.data.length), Length::mm(state.tool.data.radius)};
    run.events().on_tool({run.origin, state.tool.number, false, {}, shape});
  }
  if ((is_change || names_axis) && state.tool.number != 0) warn_of_graphics(run);
  return !block.spindle.is_programmed() || set_speed(run, run.number(block.spindle));
}

Result<void> load_tools(const Setup& setup, std::vector<ToolDefinition>& tools, int last_tool) {
  for (const ToolRecord& record : setup.tools) {
    if (record.number < 1 || record.number > last_tool) {
      return fail(Errc::Unsupported, "tool {}: this control has tools 1 to {}", record.number,
                  last_tool);
    }
    tools.push_back({static_cast<std::uint16_t>(record.number),
                     {record.length.raw(Axis::Z), record.radius.mm()}});
  }
  return {};
}

}  // namespace dripline::interpreter::tnc155
