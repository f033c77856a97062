#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// S, T and M: spindle, coolant, tools, stops.
namespace dripline::interpreter::fanuc {

/// Speeds of the block: S with G96, G97, G92.
bool apply_speed(Run& run);
/// T, then the M codes that act before the motion.
bool apply_before_motion(Run& run);
/// Those that act after it, calls and ends aside.
bool apply_after_motion(Run& run);
/// An event only when something changes.
void turn_spindle(Run& run, SpindleState state);
/// What the program keeps the operator's hands off: G63, #3003, #3004.
OverrideInhibit override_inhibit(const Run& run);
void show_override_inhibit(Run& run);
/// G05 P, G05.1 Q and G08 P prepare the control for many short blocks, and change no path. What
/// else these codes do with other numbers (cycles from binary data, smoothing) is not known here.
bool set_look_ahead(Run& run);
/// What M02 and M30 switch off.
void all_off(Run& run);

}  // namespace dripline::interpreter::fanuc
