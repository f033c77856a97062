#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Labels, repeats, subprograms, program calls, jumps and ends. A block only requests a jump; it is
/// taken before the next block, because the text of its destination may not have arrived yet.
namespace dripline::interpreter::tnc155 {

bool meet_label(Run& run, const Block& block);
bool call_label(Run& run, const Block& block);
/// FN 9 to FN 12, when the condition holds.
bool jump_to_label(Run& run, std::int32_t label);
/// CALL PGM, %.
bool call_program(Run& run, std::int32_t number);
/// The call of cycle 12: M89 is suspended until the program ends.
bool call_cycle_program(Run& run, std::int32_t number);
/// PGM n UNAVAILABLE. False.
bool fail_unavailable(Run& run, std::int64_t number);
/// END PGM, M02, M30 and the end of the text: returns to the caller, or ends the run.
void end_program(Run& run, bool rewinds);

/// Looks for a label that is set twice in the first part of a program, before it moves anything:
/// as many blocks as the control's memory has. Beyond them the first jump finds it. Finished: there
/// is none.
BlockOutcome check_first_labels(Run& run, TextSearch& search, ProgramIndex program);

/// Takes `State::jump`; afterwards the run continues at State::at.
BlockOutcome take_jump(Run& run, TextSearch& search);

}  // namespace dripline::interpreter::tnc155
