#pragma once

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

/// The block's arc (manual: circular interpolation): within one quadrant, about the stored center,
/// to an end point whose missing coordinate is zero. Loads center words. False: alarm.
bool move_arc(Run& run);
/// I, J and K alone fill their stores.
void load_center(Run& run);

}  // namespace dripline::interpreter::tektronix1704
