#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// G81-G86 and G89 (spec 11.8): at the tool's X, along Z. One-shot: the next block does not repeat
/// them. Nothing moves before every word has been found good.
/// Errors: 517, 518, 519, 520, 539, CycleTooLong.
bool run_drilling_cycle(Run& run);

}  // namespace dripline::interpreter::centurion
