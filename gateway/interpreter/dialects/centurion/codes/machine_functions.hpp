#pragma once

#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

/// M functions, spindle, coolant and tools (manual: tools; spindle; chapter 4).
namespace dripline::interpreter::centurion {

/// The M codes of the block that act at `timing`, in numerical order, from `Parts::m_next` on: a
/// wait for an input resumes there.
bool apply_machine_functions(Run& run, MTiming timing);

// What the rows of m_codes.cpp name.
/// Hands the number to the machine.
bool strobe(Run& run, const MRow& row);
bool stop_program(Run& run, const MRow& row);
bool stop_if_switched_on(Run& run, const MRow& row);
bool start_spindle(Run& run, const MRow& row);
bool stop_spindle(Run& run, const MRow& row);
bool start_coolant(Run& run, const MRow& row);
bool stop_coolant(Run& run, const MRow& row);
/// M6, or the program in its place.
bool change_tool_or_call(Run& run, const MRow& row);
bool wait_for_x_input(Run& run, const MRow& row);
bool wait_for_channel(Run& run, const MRow& row);
bool set_x_output(Run& run, const MRow& row);

/// To be called when the program in place of M6 has ended: the pending tool is in use.
void finish_tool_change(Run& run);

/// The T word: asks for a tool, or for the offsets of the one in use (manual: T word).
void apply_tool(Run& run);
/// Nose radius and type of the active offset, where programs read them (P261, P262).
void refresh_tool(Run& run);

/// Reports a spindle that rotates when the block's words have changed its speed; M3 and M4 of the
/// same block report it themselves.
void show_speed_change(Run& run, const SpindleModes& before, bool was_surface_speed);
/// M41 to M43 of the block: the range applies to its own S already.
void apply_spindle_range(Run& run);
/// Of the active spindle range (PB50).
double max_revolutions(const Run& run);
void spindle_to(Run& run, SpindleState state);
void all_off(Run& run);
/// Else the operator changes the tool at M6.
bool has_tool_changer(const Run& run);
/// Reports spindle, coolant and inhibits, to a machine that has seen nothing of the program.
void show_machine_state(Run& run);

/// The switches that the path mode inhibits (G63).
OverrideInhibit override_inhibit(const Run& run);

/// The block's comment, for the operator; nothing when it has none.
void show_comment(Run& run);

}  // namespace dripline::interpreter::centurion
