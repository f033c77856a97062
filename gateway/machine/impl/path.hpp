#pragma once

#include <array>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::machine::impl {

/// A point by axis number: millimeters or, for rotary axes, degrees.
using Coordinates = std::array<double, interpreter::kAxisCount>;

/// Takes over the axes that `position` has; the others stay.
void take_over(Coordinates& point, const interpreter::Position& position);
interpreter::Position to_position(const Coordinates& point, const interpreter::Position& axes_of);

/// The part of a path that is no straight line: a circle in the plane of two axes, seen as polar
/// coordinates around its center. The radius may change evenly along the path (rounded programs end
/// slightly off the circle); all other axes move evenly with the angle.
struct Circle {
  std::size_t first = 0, second = 1;  ///< axis numbers
  double center_first = 0, center_second = 0;
  double radius = 0;         ///< at the start; 0: the path is straight
  double radius_change = 0;  ///< from start to end
  double start = 0;          ///< radians
  double sweep = 0;          ///< radians, counterclockwise positive
};

struct Range {
  double low, high;
};

/// The geometry of one move: from, to, and the path between. `length` is in millimeters; of a move
/// of rotary axes only, in degrees. Value type; pure.
struct Path {
  Coordinates from{}, to{};
  double length = 0;
  Circle circle;

  bool is_arc() const { return circle.radius > 0; }
  Coordinates at(double distance) const;
  /// Change of the axes by one unit of length, at either end.
  Coordinates direction_at_start() const;
  Coordinates direction_at_end() const;
  /// The largest movement of this axis for one unit of length, anywhere on the path.
  double share(std::size_t axis) const;
  /// `length` in relation to that of all axes together, degrees as millimeters.
  double part_of_all_axes() const;
  /// The range of this axis on the path.
  Range range(std::size_t axis) const;
};

Path straight_path(const Coordinates& from, const Coordinates& to);
/// The turn is the one that meets the end; `arc.turn` decides where both do (half and full circles,
/// whose direction the geometry leaves open).
Path arc_path(const Coordinates& from, const interpreter::Arc& arc);

}  // namespace dripline::machine::impl
