#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// The machine parameters in a setup's text, as a TNC takes them, or the parameter file of an
/// rs274ngc control. Errors: those of parse_control_data and of the form; Syntax, LimitExceeded,
/// Unsupported (a parameter, one that the setup's model and software have not), NotFound (none is
/// there).
Result<std::string> machine_parameters_text(std::string_view toml,
                                            std::string_view control = "tnc155");

/// The tool store of a TNC 151/155 (its program 0) from a setup's text, in the setup's units.
/// Errors: those of parse_control_data and write_tool_store.
Result<std::string> tool_store_of(std::string_view toml);

/// A setup as its control takes it over a line: the tool store of a TNC, a program of G10 for a
/// control of the Fanuc class, LinuxCNC's tool table, or a Centurion's parameters as a program, in
/// the control's numbers where `map` (the text of a parameter map) gives them; else in our own,
/// marked as such. Errors: those of parse_control_data, of the form and of the map; Unsupported (a
/// TNC without a tool store).
Result<std::string> control_form_of(std::string_view toml, std::string_view control,
                                    std::string_view map = {});

/// The text of a setup from what a control sent: a Centurion's parameters (they hold a G10), else a
/// TNC's tool store or machine parameters (MP0: ...), of which `tnc` must have all. `map` as above.
/// Errors: Syntax, LimitExceeded, Unsupported; with the line.
Result<std::string> setup_of_control_form(std::string_view text,
                                          const interpreter::tnc155::ControlVersion& tnc,
                                          std::string_view map = {});

/// LinuxCNC's tool table or parameter file.
bool is_table_file(std::string_view text);
/// The text of a setup from one of them, or from both; `units` are those of the machine. Errors:
/// Syntax (with the line), LimitExceeded, Unsupported.
Result<std::string> setup_of_table_files(const std::vector<std::string>& texts,
                                         interpreter::Units units);

}  // namespace dripline::cli
