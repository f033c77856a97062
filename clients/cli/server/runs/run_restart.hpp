#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc run restart`.
void add_run_restart_command(Command group, Context& context);

}  // namespace dripline::cli
