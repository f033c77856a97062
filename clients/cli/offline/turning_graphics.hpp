#pragma once

#include "clients/cli/context.hpp"
#include "clients/cli/offline/graphics_options.hpp"

namespace dripline::cli {

/// `dnc graphics` for a lathe's program: simulates the turned bar, draws the part and the tool
/// path. Returns the exit status.
int show_turned(Context& context, const GraphicsCommand& command, const OfflineProgram& program);

}  // namespace dripline::cli
