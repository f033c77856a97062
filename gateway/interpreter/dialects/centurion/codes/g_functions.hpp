#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// What the G codes, F and S of a block do before anything moves (spec 12.3, step 3), and the
/// one-shot functions that act in the place of a move (step 5).
namespace dripline::interpreter::centurion {

bool apply_modes(Run& run);
/// Dwell and coordinate settings; leaves moves to motion.hpp.
bool apply_one_shots(Run& run);

/// Words that nothing in the block takes are error 501: before anything is done by the tables of
/// the codes, which say what each may have, afterwards by what has used them.
bool check_words(Run& run);
bool check_words_used(Run& run);

}  // namespace dripline::interpreter::centurion
