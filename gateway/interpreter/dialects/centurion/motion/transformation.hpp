#pragma once

#include "gateway/interpreter/dialects/centurion/compensation/plane_point.hpp"

/// Mirror, scaling and rotation: the programmed point is mirrored, then scaled, then rotated
/// (manual: G511, G551, G568).
namespace dripline::interpreter::centurion {

/// Points are relative to the active zero, in program units, X a radius.
struct Transformation {
  bool mirrors_x = false;
  bool mirrors_z = false;
  bool scales = false;
  bool rotates = false;
  Point mirror;  ///< where the lines of symmetry are
  Point scale_center;
  Point factor{1, 1};
  Point rotation_center;  ///< scaled already, when scaling was on before rotation
  double degrees = 0;     ///< counterclockwise

  bool mirrors() const { return mirrors_x || mirrors_z; }
  bool is_on() const { return mirrors() || scales || rotates; }
  /// Whether left and right, clockwise and counterclockwise change places.
  bool swaps_sides() const;
  /// The factor of radii (manual: scaling).
  double length_factor() const;
  Point apply(Point point) const;
  Point undo(Point point) const;
};

}  // namespace dripline::interpreter::centurion
