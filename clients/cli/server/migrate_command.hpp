#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc server migrate`.
void add_migrate_command(Command server, Context& context);

}  // namespace dripline::cli
