#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/setup.hpp"

namespace dripline::cli {

/// Tools as the TOML of a setup, in millimetres.
std::string tools_toml(const std::vector<interpreter::ToolRecord>& tools);

/// The tool store of a TNC 151/155 (its program 0) from a setup's text, in the setup's units.
/// Errors: those of parse_control_data and write_tool_store.
Result<std::string> tool_store_of(std::string_view toml);

}  // namespace dripline::cli
