#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

/// Executes what was read, in the control's order. False when it pauses; a skip move's answer is
/// taken up by calling it again.
bool execute_block(Run& run);

/// Before `execute_block` of a block just read: which of its words have to lead to something.
void open_ledger(Run& run);
/// After it, when words are left: a warning, or, where the tool would be elsewhere, an alarm.
[[gnu::cold]] bool report_left_words(Run& run);

// G73, G74, G76, G80 to G89.

/// A block while a cycle is in force: keeps its data and drills when it names an axis or R.
bool execute_cycle(Run& run);
/// The mode began with this block: the level to come back to.
void begin_cycle_mode(Run& run);

}  // namespace dripline::interpreter::fanuc
