#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// TOOL DEF with length and radius; without them the next tool (G51).
bool define_tool(Run& run, const Block& block);
/// How many blocks of the text may have the TOOL DEF of a TOOL CALL whose tool neither the central
/// file nor the run has: one further on counts, and has to be in Run::definition_ahead before
/// `call_tool`. Where the setup has the tool, which is the last resort, only as many as the control
/// keeps, so that the first cut does not wait for all of a long program. 0: none is needed.
std::uint64_t reach_of_definition(const Run& run, const Block& block);
/// TOOL CALL, and the plane functions of ISO.
bool call_tool(Run& run, const Block& block);
/// What the setup says of tools: the central tool file, or tools defined before.
Result<void> load_tools(const Setup& setup, std::vector<ToolDefinition>& tools);

}  // namespace dripline::interpreter::tnc155
