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
bool fail_at_end_of_record(Run& run);

// Which call, return or end a block asks for: found while it is executed, done when it is left
// (calls.cpp). False: an alarm.

/// M02, M30, M98, M99 of the block.
bool plan_flow_of_m_codes(Run& run);
/// G65, G66 and codes that call.
bool plan_macro_call(Run& run);
/// After a block with motion while G66 is in force.
bool plan_modal_call(Run& run);
/// G67
void cancel_modal_call(Run& run);

}  // namespace dripline::interpreter::fanuc
