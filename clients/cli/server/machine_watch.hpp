#pragma once

#include <string>

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// Follows one machine (or all: empty name) until Ctrl-C; gives the exit status.
int watch_machines(Context& context, const std::string& name);

}  // namespace dripline::cli
