#pragma once

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

/// Executes the block in `state.block`, in the order that README, "Decided here", gives. False:
/// alarm.
bool execute_block(Run& run);

}  // namespace dripline::interpreter::tektronix1704
