#pragma once

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

/// Executes the block in `state.block`, in the control's order (spec 15). False: alarm.
bool execute_block(Run& run);

}  // namespace dripline::interpreter::tektronix1704
