#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Program coordinates and machine coordinates, and the codes that change how they depend on each
/// other (NIST 3.5; LinuxCNC: G10, G92). machine = rotated(program + G92 offset) + origin of the
/// system.
namespace dripline::interpreter::rs274ngc {

inline constexpr std::size_t kX = index_of(Axis::X), kY = index_of(Axis::Y);

/// Machine coordinates of a program point; no axis is marked as moved that was not.
Position to_machine(const Run& run, const Axes& program);
/// The inverse; `machine` in millimeters and degrees.
Axes to_program(const Run& run, const Axes& machine);

/// What the screen shows of offsets and rotation.
CoordinateFrame frame_of(const Run& run);

/// X and Y about the origin.
struct Turned {
  double x, y;
};
Turned turned(double x, double y, double degrees);

/// The coordinates of the line's axis words over those of `axes`.
void take_axis_words(Run& run, Axes& axes);

/// The point of G53, G28 and G30: machine coordinates with the tool length on top.
Axes machine_with_length(const Run& run);
Axes program_of_machine_with_length(const Run& run, const Axes& machine);

/// A length of the machine's memory in millimeters, and back; rotary axes stay degrees.
double from_memory(const Run& run, Axis axis, double value);
double to_memory(const Run& run, Axis axis, double mm);

/// Loads origin and rotation of a system out of the parameters; the machine does not move.
void load_system(Run& run, int system);
void set_tool_length(Run& run, const Axes& length);

bool select_system(Run& run, int g_code);
bool set_length_offset(Run& run, int g_code);
/// G10, G28, G28.1, G30, G30.1, G52, G92 and its family.
bool execute_one_shot(Run& run, int g_code);
/// What M2 and M30 do to coordinates.
void reset_coordinates(Run& run);

}  // namespace dripline::interpreter::rs274ngc
