#pragma once

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

/// The block in a fixed cycle (manual: G80 to G89): loads R and Z, positions, and works the hole as
/// the cycle table says. False: alarm.
bool run_cycle(Run& run);

}  // namespace dripline::interpreter::tektronix1704
