#pragma once

#include <array>

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Scaling (G51) and rotation (G68): program coordinates to those that the offsets are added to.
namespace dripline::interpreter::fanuc {

/// X, Y, Z.
using Point3 = std::array<double, 3>;

Point3 transform(const ModalState& state, Point3 point);
Point3 transform_back(const ModalState& state, Point3 point);
/// The present place in program coordinates before both.
Point3 program_position(const Run& run);
/// What the screen shows of offsets, scaling and rotation.
CoordinateFrame frame_of(const Run& run);
/// Turns change their sense: an odd number of mirrored axes in the plane.
bool is_plane_mirrored(const ModalState& state, Plane plane);

/// G50, G51, G68, G69. False: an alarm.
bool apply_scaling(Run& run);
bool apply_rotation(Run& run);

}  // namespace dripline::interpreter::fanuc
