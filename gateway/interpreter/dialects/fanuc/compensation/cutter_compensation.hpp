#pragma once

#include "gateway/interpreter/dialects/fanuc/options.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"
#include "gateway/interpreter/stages/compensation/policy.hpp"

/// Cutter compensation C: how G40, G41, G42 and D drive the shared stage that offsets the path.
namespace dripline::interpreter::fanuc {

struct Run;

/// Which moves wait for their corner.
blending::Policy corner_policy();
/// The move of the block in hand ends in a corner that its word shapes. False: an alarm.
bool announce_corner(Run& run);
/// The block after that of a corner word is the move that the corner leads to. False: an alarm.
bool check_open_corner(Run& run);
/// No move waits for its successor any more. False: an alarm, of a corner that has none.
bool end_waiting(Run& run);

compensation::Policy policy_of(const ControlOptions& options);

/// G40, G41, G42 and D of the block, before its motion. False: an alarm.
bool apply_compensation(Run& run);
/// G39: round the corner on the cutter's circle, to the normal of the next block's begin, or to
/// that of the direction of I, J, K. False: an alarm.
bool round_corner(Run& run);
/// What interrupts compensation calls `interrupt` before and `resume` after its moves. By choice
/// the first of them keeps the distance that the tool has.
void interrupt_compensation(Run& run, bool first_keeps_distance = false);
void resume_compensation(Run& run);
/// The end of the block, as the look-ahead takes it: macro statements, calls, returns and blocks
/// without words are no blocks without motion, since nothing of them reaches the machine.
void end_compensated_block(Run& run);
/// False: the alarm of a contour that cannot be offset.
bool check_compensation(Run& run);

}  // namespace dripline::interpreter::fanuc
