#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc server backup`, `backups`, `verify`, `remove-backup`.
void add_backup_commands(Command server, Context& context);

}  // namespace dripline::cli
