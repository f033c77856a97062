#pragma once

#include <string>

#include "clients/cli/context.hpp"
#include "clients/lib/api_types.hpp"
#include "clients/lib/client.hpp"

namespace dripline::cli {

inline constexpr const char* kSwitchHelp =
    "single_block, optional_stop, block_skip (block_skip_2 to block_skip_9 where the control has "
    "them), dry_run, machine_lock, test_run, handwheel or emergency_stop";

/// A dash is read as an underscore: "emergency-stop".
client::CommandRequest switch_command(std::string name, bool is_on);
/// "hold", "feed override 50 %", "single_block on"
std::string command_text(const client::CommandRequest& command);

/// Adds hold, resume, abort, answer, switch and override to the group `run`.
void add_run_control_commands(Command group, Context& context);

/// The help text of every verb for its run.
inline constexpr const char* kRunHelp = "The run: its id, the beginning of it, or latest";

/// The run that `reference` means: a full id, a prefix that fits only one run, or `latest`.
/// Failures: those of the calls; Refused with NotFound (none fits) or Conflict (several fit;
/// named).
client::Reply<client::Run> find_run(client::Client& client, const std::string& reference);

}  // namespace dripline::cli
