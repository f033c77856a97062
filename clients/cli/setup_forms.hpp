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

/// A setup as its control takes it over a line: a Centurion's parameters as a program, else the
/// tool store of a TNC. Errors: those of parse_control_data, of the form.
Result<std::string> control_form_of(std::string_view toml, std::string_view control);

/// The text of a setup from what a control sent: a Centurion's parameters (they hold a G10), else a
/// TNC's tool store. Errors: Syntax.
Result<std::string> setup_of_control_form(std::string_view text);

}  // namespace dripline::cli
