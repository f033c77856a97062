#pragma once

#include "clients/cli/context.hpp"
#include "clients/lib/api_types.hpp"

namespace dripline::cli {

inline constexpr const char* kSwitchHelp =
    "single_block, optional_stop, block_skip, handwheel or emergency_stop";

/// A dash is read as an underscore: "emergency-stop".
client::CommandRequest switch_command(std::string name, bool is_on);
/// "hold", "feed override 50 %", "single_block on"
std::string command_text(const client::CommandRequest& command);

/// Adds hold, resume, abort, answer, switch and override to the group `run`.
void add_run_control_commands(Command group, Context& context);

}  // namespace dripline::cli
