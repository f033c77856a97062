#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// Adds hold, resume, abort, answer, switch and override to the group `run`.
void add_order_commands(CLI::App& group, Context& context);

}  // namespace dripline::cli
