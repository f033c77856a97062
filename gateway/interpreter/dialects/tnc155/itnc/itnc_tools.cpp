#include <fmt/core.h>
#include <string>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/tools.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"

/// TOOL CALL of the later controls.
namespace dripline::interpreter::tnc155::itnc {
namespace {

/// The number of the setup's tool with this name.
bool find_tool_name(Run& run, const std::string& name, std::int32_t& number) {
  std::string numbers;
  int count = 0;
  for (const ToolName& tool : run.tool_names) {
    if (tool.name != name) continue;
    number = tool.number;
    numbers += fmt::format("{}{}", count++ == 0 ? "" : ", ", tool.number);
  }
  if (count == 1) return true;
  return run.fail(ErrorCode::ToolDefMissing,
                  count == 0 ? fmt::format("the setup has no tool with the name \"{}\"", name)
                             : fmt::format("the name \"{}\" is that of tools {}", name, numbers));
}

}  // namespace

bool call_tool(Run& run, const Block& block) {
  State& state = run.state;
  const ItncWords& words = run.parts.itnc;
  Block call = block;
  if (!words.name.empty() && !find_tool_name(run, words.name, call.target)) return false;
  if (words.tool.is_programmed()) {
    const double number = run.number(words.tool);
    if (!(number >= 0 && number <= kLastItncTool) || number != static_cast<int>(number)) {
      return run.fail(ErrorCode::EntryOutOfRange, fmt::format("TOOL CALL {}", number));
    }
    call.target = static_cast<std::int32_t>(number);
  }
  const bool has_delta = words.delta_length.is_programmed() || words.delta_radius.is_programmed();
  if (has_delta && call.target == Block::kNone) {
    return run.fail(ErrorCode::NotSupported, "DL or DR in TOOL CALL without a tool");
  }
  const bool is_change = call.target != Block::kNone || call.axis.has_value();
  if (is_change && run.tilted.is_on() && !check_tilted_tool(run)) return false;
  if (run.tilted.is_on() && call.axis.value_or(Axis::Z) != Axis::Z)
    return run.fail(ErrorCode::TiltFailed, "another tool axis than Z");
  if (!tnc155::call_tool(run, call)) return false;
  run.tilted.set_length(state.tool.data.length);
  if (call.target != Block::kNone) state.tool_feed = 0;
  if (words.feed.is_programmed()) {
    if (!read_cycle_feed(run, words.feed, state.tool_feed)) return false;
    state.feed = state.tool_feed;
    state.rotary_feed = rotary_feed_of(run, state.feed);
  }
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
