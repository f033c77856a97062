#pragma once

#include <string>

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// deploy/docs/options.md: the options of every control, from the rows that read them.
std::string options_reference();

/// `dnc setup options`.
void add_setup_options(Command group, Context& context);

}  // namespace dripline::cli
