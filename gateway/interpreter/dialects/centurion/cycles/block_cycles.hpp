#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The cycles of one block without threads. Every word is checked before anything moves.
namespace dripline::interpreter::centurion {

/// G90, cycle A: in along X, cut to the end, out along X, back to the start point (manual: G90).
bool cut_turning_box(Run& run);
/// G94, cycle B: in along Z, cut to the end, out along Z, back to the start point (manual: G94).
bool cut_facing_box(Run& run);

/// G81-G86 and G89 (manual): at the tool's X, along Z. One-shot: the next block does not repeat
/// them. Errors: 517, 518, 519, 520, 539, CycleTooLong.
bool run_drilling_cycle(Run& run);
/// G74 (grooves in a face, high-speed pecks) and G75 (grooves in a diameter): the same cycle along
/// Z and along X. Errors: 517, 519, CycleTooLong.
bool run_groove_cycle(Run& run);

}  // namespace dripline::interpreter::centurion
