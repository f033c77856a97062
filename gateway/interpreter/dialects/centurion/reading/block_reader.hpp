#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// Reads the items of the visible block from left to right, beginning at `parts.resume`: words are
/// kept for execution, assignments and statements take effect at once, and a false IF ends the
/// block.
bool read_items(Run& run);

}  // namespace dripline::interpreter::centurion
