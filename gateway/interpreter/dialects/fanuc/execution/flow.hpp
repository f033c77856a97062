#pragma once

#include "gateway/interpreter/dialects/fanuc/reading/text_search.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Where a block leads: jumps and calls are taken, loops and programs come to their ends.
namespace dripline::interpreter::fanuc {

/// Moves the place in the text after the block, or back, or asks for a jump.
bool leave_block(Run& run);

/// Takes the jump that is open.
BlockOutcome take_jump(Run& run, TextSearch& search);

/// No block is left: % or the next O, or the end of the text.
bool departure_end(Run& run);

}  // namespace dripline::interpreter::fanuc
