#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Work coordinates and what shifts them: G10, G22, G23, G52, G54 to G59, G92.
namespace dripline::interpreter::fanuc {

/// G54 to G59 and G54.1 P.
bool select_work_system(Run& run);
bool set_local_zero(Run& run);
bool set_position(Run& run);
/// G92.1: what G92 and G52 have shifted is undone.
bool preset_coordinates(Run& run);
/// G10 with its lists.
bool set_data(Run& run);
/// G22, G23.
bool set_stroke_zone(Run& run);

// Scaling (G51) and rotation (G68), transformation.cpp: program coordinates to those that the
// offsets are added to.

constexpr std::size_t place(Axis axis) {
  return static_cast<std::size_t>(axis);
}
/// The point without the offsets in force, before scaling and rotation.
Point3 program_point(const ModalState& state, const Position& at);

Point3 transform(const ModalState& state, Point3 point);
Point3 transform_back(const ModalState& state, Point3 point);
/// The present place in program coordinates before both.
Point3 program_position(const Run& run);
/// What the screen shows of offsets, scaling and rotation.
CoordinateFrame frame_of(const Run& run);
/// Arcs change their direction: an odd number of mirrored axes in the plane.
bool is_plane_mirrored(const ModalState& state, Plane plane);

/// G50.1, G51.1, G50, G51, G68, G68.2, G69. False: an alarm.
bool apply_transformations(Run& run);
/// The words of G22, G51, G51.1, G68 and G68.2; any others have no use.
void take_data_words(Run& run);
/// Whether the axis words of the block say where they lead after a change of scaling, mirror image
/// or rotation. False: an alarm.
bool check_open_axes(Run& run);

}  // namespace dripline::interpreter::fanuc
