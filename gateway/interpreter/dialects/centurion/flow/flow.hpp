#pragma once

#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Where the program continues: jumps, loops, subroutines, calls, ends (manual: program flow).
namespace dripline::interpreter::centurion {

/// M2, M30, M98 and M99 of the block, or the program it calls with arguments, become its ending or
/// its jump.
bool plan_flow(Run& run);

/// Continues after the visible block, or where its ending leads; a jump that needs other text is
/// left in `state.jump`.
bool leave_block(Run& run);

/// Takes the jump of `state.jump`.
BlockOutcome take_jump(Run& run, TextSearch& search);

/// Why a search has not found its place. Not for Found and Missing, which each caller handles.
BlockOutcome refuse_search(Run& run, TextSearch::Outcome outcome);

/// The text of the program that is running has ended without an end code.
bool end_without_code(Run& run);

}  // namespace dripline::interpreter::centurion
