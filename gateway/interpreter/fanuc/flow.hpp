#pragma once

#include "gateway/interpreter/fanuc/run.hpp"
#include "gateway/interpreter/fanuc/text_search.hpp"

/// Where a block leads: calls, returns, jumps, loops and the program's end.
namespace dripline::interpreter::fanuc {

/// M02, M30, M98, M99 of the block.
bool plan_flow_of_m_codes(Run& run);
/// G65, G66 and codes that call.
bool plan_macro_call(Run& run);
/// After a block with motion while G66 is in force.
bool plan_modal_call(Run& run);
void cancel_modal_call(Run& run);

/// Moves the place in the text behind the block, or back, or asks for a jump.
bool leave_block(Run& run);

enum class JumpOutcome : std::uint8_t { Taken, NeedsText, More, Failed };
/// Takes the jump that is open.
JumpOutcome take_jump(Run& run, TextSearch& search);

/// No block is left: % or the next O, or the end of the text.
bool run_off_end(Run& run);

}  // namespace dripline::interpreter::fanuc
