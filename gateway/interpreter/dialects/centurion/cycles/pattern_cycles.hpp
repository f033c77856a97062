#pragma once

#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"

/// The cycles that follow a pattern, blocks N P to N Q of the program (manual: G70 to G73).
///
/// G70 jumps to the pattern, executes its blocks and returns. G71, G72 and G73 jump there too, but
/// the moves that come out of all stages are recorded instead of made. The passes are then made
/// from the record, one per step of the interpreter, each as a block of its own, and the program
/// continues after the pattern in the modes it was in before.
namespace dripline::interpreter::centurion {

/// G70-G73: takes the block's words; the jump to the pattern follows the block.
bool plan_pattern_cycle(Run& run);

/// Reads the words of the block into `cycle` and P110-P119 (pattern_recorder.cpp). False: an alarm.
bool read_pattern_words(Run& run, PatternCycle& cycle, std::uint32_t& first_label);

/// Takes the jump to the pattern: both its ends are found.
BlockOutcome enter_pattern(Run& run, TextSearch& search);

/// After a block of a pattern: its last one ends the pattern.
bool leave_pattern_block(Run& run);

/// Whether a pass has to be made before the program continues.
inline bool has_pattern_pass(const ModalState& state) {
  return is_making_passes(state.pattern);
}
void make_pattern_pass(Run& run);

/// The program must not end while its pattern is read.
inline bool is_reading_pattern(const ModalState& state) {
  return state.pattern.phase == PatternPhase::Reading;
}

}  // namespace dripline::interpreter::centurion
