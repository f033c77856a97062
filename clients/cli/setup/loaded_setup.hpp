#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc setup loaded`: which setup is in a control that gets none with a start.
void add_loaded_setup(Command group, Context& context);

}  // namespace dripline::cli
