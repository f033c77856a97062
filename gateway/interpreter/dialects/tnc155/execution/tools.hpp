#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// TOOL DEF with length and radius; without them the next tool (G51).
bool define_tool(Run& run, const Block& block);
/// How many blocks of the text are searched for the TOOL DEF of a TOOL CALL whose tool is neither
/// in the central file nor defined in the run: a later definition applies, and has to be in
/// Run::definition_ahead before `call_tool`. Where the setup has the tool, which is the last
/// resort, only as many as fit the control's memory, so that the first cut does not wait for a
/// whole long program. 0: no search is needed.
std::uint64_t reach_of_definition(const Run& run, const Block& block);
/// Of the tool file, of a TOOL DEF or of the setup; nullptr: there is no such tool.
const ToolData* find_tool(const Run& run, int number);
/// TOOL CALL, and the plane functions of ISO.
bool call_tool(Run& run, const Block& block);
/// Loads the tools of the setup: the central tool file, or tools defined before.
Result<void> load_tools(const Setup& setup, std::vector<ToolDefinition>& tools, int last_tool);

}  // namespace dripline::interpreter::tnc155
