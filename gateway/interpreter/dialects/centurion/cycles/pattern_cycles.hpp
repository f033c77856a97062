#pragma once

#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"

/// The cycles that follow a pattern, blocks N P to N Q of the program (spec 11.3-11.6).
///
/// G70 goes to the pattern, executes its blocks and comes back. G71, G72 and G73 go there too, but
/// the moves, as they come out of all stages, are kept instead of made; the passes are then made
/// from these, one a step of the interpreter, each counted as a block; and the program goes on
/// after the pattern, in the modes it was in before.
namespace dripline::interpreter::centurion {

/// G70-G73: takes the block's words; the jump to the pattern follows the block.
bool plan_pattern_cycle(Run& run);

/// Takes the jump to the pattern: both its ends are found.
JumpOutcome enter_pattern(Run& run, TextSearch& search);

/// After a block of a pattern: its last one ends the pattern.
bool leave_pattern_block(Run& run);

/// A pass is to be made before the program goes on.
inline bool has_pattern_pass(const ModalState& state) {
  return is_making_passes(state.pattern);
}
void make_pattern_pass(Run& run);

/// The program may not end while its pattern is read.
inline bool is_reading_pattern(const ModalState& state) {
  return state.pattern.phase == PatternPhase::Reading;
}

}  // namespace dripline::interpreter::centurion
