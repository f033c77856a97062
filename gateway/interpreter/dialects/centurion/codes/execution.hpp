#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

/// Executes what was read, in the order that README.md gives. False when it pauses; with the answer
/// of a probe move it is called again.
bool execute_block(Run& run);

// Steps of it.
/// The G codes, F and S of the block, before anything moves.
bool apply_modes(Run& run);
/// The dwell, G12 and G45 to G48, in the order written.
bool act_before_move(Run& run);

/// Words that nothing in the block takes are error 501: before anything is done by the tables of
/// the codes, which say what each may have, afterwards by what has used them.
bool check_words(Run& run);
bool check_words_used(Run& run);

}  // namespace dripline::interpreter::centurion
