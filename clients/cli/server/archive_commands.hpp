#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc server archive`, `archives`.
void add_archive_commands(Command server, Context& context);

}  // namespace dripline::cli
