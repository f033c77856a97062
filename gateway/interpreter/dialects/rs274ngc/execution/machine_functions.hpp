#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Spindle, tools, coolant, inputs and outputs, stops (NIST 3.6, 3.7).
namespace dripline::interpreter::rs274ngc {

/// Delivers state and speed of the spindle.
void show_spindle(Run& run);
/// Shows and keeps a new state of the spindle.
void turn_spindle(Run& run, SpindleState state);

/// S, T, and the M codes that act before the line's moves. Stage::Input comes first, for it may
/// ask.
bool apply_speed_and_tool(Run& run);
bool apply_inputs(Run& run);
bool apply_machine_functions(Run& run);
/// G96 and G97.
bool apply_spindle_mode(Run& run);

/// What M48 to M53 keep the operator's hands off.
OverrideInhibit override_inhibit(const Run& run);

/// M0, M1, M60, M2, M30.
bool apply_stops(Run& run);
/// What M2, M30 and the end of a program reset (NIST 3.6.1).
bool reset_at_end(Run& run);

}  // namespace dripline::interpreter::rs274ngc
