#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// The forms in which G68.2 gives a plane.
namespace dripline::interpreter::fanuc {

/// Reads zero and axes of the plane into `tilt.at` and `tilt.frame`. False: an alarm.
bool read_plane(Run& run, Tilt& tilt);

}  // namespace dripline::interpreter::fanuc
