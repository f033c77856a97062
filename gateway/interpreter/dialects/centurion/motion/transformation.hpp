#pragma once

#include "gateway/interpreter/dialects/centurion/compensation/plane_point.hpp"

/// Mirror, scaling and rotation (spec 19): programmed point, mirrored, then scaled, then turned.
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
  /// Left and right, clockwise and counterclockwise change places.
  bool swaps_sides() const;
  /// Of radii (spec 19.2).
  double length_factor() const;
  Point apply(Point point) const;
  Point undo(Point point) const;
};

}  // namespace dripline::interpreter::centurion
