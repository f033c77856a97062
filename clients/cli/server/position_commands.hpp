#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// dnc machine datum, touch-off, playback.
void add_position_verbs(Command group, Context& context);

}  // namespace dripline::cli
