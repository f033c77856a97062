#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// G73, G74, G76, G80 to G89.
namespace dripline::interpreter::fanuc {

/// A block while a cycle is in force: keeps its data and drills when it names an axis or R.
bool execute_cycle(Run& run);
/// The mode began with this block: the level to come back to.
void begin_cycle_mode(Run& run);

}  // namespace dripline::interpreter::fanuc
