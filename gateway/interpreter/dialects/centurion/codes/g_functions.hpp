#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The G codes, F and S of a block, as far as they take effect before the axis words do, and the
/// check that something takes each word.
namespace dripline::interpreter::centurion {

bool apply_modes(Run& run);
/// The dwell, G12 and G45 to G48, in the order written.
bool act_before_move(Run& run);

/// Words that nothing in the block takes are error 501: before anything is done by the tables of
/// the codes, which say what each may have, afterwards by what has used them.
bool check_words(Run& run);
bool check_words_used(Run& run);

}  // namespace dripline::interpreter::centurion
