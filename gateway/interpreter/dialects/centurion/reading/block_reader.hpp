#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// Reads the items of the visible block from left to right, beginning at `parts.resume`: words are
/// kept for execution, assignments and statements take effect where they stand, a false IF ends the
/// block (spec 12.3).
bool read_items(Run& run);

}  // namespace dripline::interpreter::centurion
