#pragma once

#include "gateway/interpreter/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// TOOL DEF with length and radius; without them the next tool (G51).
bool define_tool(Run& run, const Block& block);
/// TOOL CALL of a tool of which nothing is known yet: a TOOL DEF further on in the text counts, and
/// has to be in Run::definition_ahead before `call_tool`.
bool needs_definition_ahead(const Run& run, const Block& block);
/// TOOL CALL, and the plane functions of ISO.
bool call_tool(Run& run, const Block& block);
/// What the setup says of tools: the central tool file, or tools defined before.
Result<void> load_tools(const Setup& setup, std::vector<ToolDefinition>& tools);

}  // namespace dripline::interpreter::tnc155
