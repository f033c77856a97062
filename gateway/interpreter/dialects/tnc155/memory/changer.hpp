#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// The random tool changer: the tool that leaves the spindle goes into the pocket of the one that
/// comes, so that pockets belong to no tool. `State::pockets` is the tool store's column of them.
///
/// - Pocket 0 is the spindle: the tool that has it waits there for the next change.
/// - A special tool keeps its pocket, also while it is in the spindle, and takes those on both
/// sides
///   of it. The tool that it replaces in the spindle, and one replaced by a tool without a pocket,
///   goes into the lowest pocket that is free.
/// - A tool without a pocket, or none of the store, is changed by hand and never gets one.
/// - TOOL CALL 0 ends the compensation and changes no tool.
/// Source: the manual, central tool store. Pocket 0, and the pocket for a tool that cannot have the
/// other one's, are decided here (decisions.md).
namespace dripline::interpreter::tnc155 {

/// Of the setup's tools, where `random_changer` is on; else empty. Errors: Syntax (a pocket beyond
/// the magazine, two tools in one, next to a special tool, two in the spindle; `magazine_pockets`
/// or `central_tool_file` is missing).
Result<std::vector<ToolPocket>> load_pockets(const Setup& setup, const ControlOptions& options);

/// TOOL CALL of `number`; each tool whose pocket changes is reported as a line. Nothing without a
/// random changer.
bool change_tool(Run& run, int number);

/// All pockets, a line a tool: at the end of a run.
void report_pockets(Run& run);

/// "T5 P8", "T10 SP20", "T11 P": as the store writes them.
std::string pocket_text(const ToolPocket& tool);
/// What `pocket_text` gave; nothing for any other text.
std::optional<ToolPocket> read_pocket_text(std::string_view text);

}  // namespace dripline::interpreter::tnc155
