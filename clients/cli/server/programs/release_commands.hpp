#pragma once

#include <string>

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// "in review".
std::string state_text(const std::string& state);
/// submit, approve, reject, release, withdraw, closure, states: below `dnc program`.
void add_closure_command(Command group, Context& context);
void add_release_commands(Command group, Context& context);

}  // namespace dripline::cli
