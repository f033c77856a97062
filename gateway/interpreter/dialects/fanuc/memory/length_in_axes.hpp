#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Which axes of a machine are where the program's position and the length in force say: one that
/// machine coordinates (G28, G30, G53) have placed is there without the length, until the program
/// moves it. For machines with axes of their own; positions of events do not depend on it.
namespace dripline::interpreter::fanuc {

/// Before the moves of a block in program coordinates: the axes that it names take the length in.
void note_programmed_axes(Run& run);
/// Before the move of a block's axes to machine coordinates. In compensation it is not certain
/// which move is given when.
void note_machine_axes(Run& run);
/// G92, G50: a present position that is another one than that of the tip gives coordinates of which
/// it is not certain what they mean.
void note_set_axes(Run& run);

/// How far the machine's axis is beyond the program's position, mm (X of a lathe as a radius).
double length_along(const Run& run, Axis axis);
/// The same in positions of the work system that hold the tool's offset. NaN: a lathe's geometry
/// offset, which moves the tool on some machines and the work system on others.
double length_in_work_position(const Run& run, Axis axis);

/// What modes() has: see ActiveModes. Only axes with a length.
std::uint8_t bare_axes(const ModalState& state, const ActiveModes& modes);
bool is_length_doubtful(const ModalState& state, const ActiveModes& modes);

}  // namespace dripline::interpreter::fanuc
