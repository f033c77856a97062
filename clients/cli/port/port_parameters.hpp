#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc port parameters`: the interface of a TNC 151/155 by its machine parameters, and the line.
void add_port_parameters_command(Command group, Context& context);

}  // namespace dripline::cli
