#pragma once

#include "gateway/interpreter/core/active_modes.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// What the control's status window shows for the block that was executed last.
ActiveModes active_modes(const Run& run);

}  // namespace dripline::interpreter::centurion
