#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The single cuts out of the start point and back to it (spec 11.1).
namespace dripline::interpreter::centurion {

/// G90, cycle A: in along X, cut to the end, out along X, back.
bool cut_turning_box(Run& run);
/// G94, cycle B: in along Z, cut to the end, out along Z, back.
bool cut_facing_box(Run& run);

}  // namespace dripline::interpreter::centurion
