#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// dnc machine jog, stop-jog.
void add_jog_verbs(Command group, Context& context);

}  // namespace dripline::cli
