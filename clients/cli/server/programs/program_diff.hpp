#pragma once

#include "clients/cli/command_line.hpp"

namespace dripline::cli {

class Context;

/// `program diff`: two revisions of programs of the server.
void add_program_diff(Command group, Context& context);

}  // namespace dripline::cli
