#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/modal_state.hpp"

/// Circles in the work plane: +Z to the right, +X up, angle 0 along +Z, counterclockwise positive.
/// All lengths are in one unit, X is a radius. Pure.
namespace dripline::interpreter::centurion {

double distance(const Point& a, const Point& b);
/// The point at `length` from `pole` in direction `degrees`.
Point polar(const Point& pole, double length, double degrees);

struct RadiusArc {
  Point start;
  Point end;
  double radius = 0;  ///< negative: the arc above 180 degrees
  bool is_clockwise = false;
};
/// The center, or nullopt when the chord is longer than the diameter by more than `tolerance`.
std::optional<Point> center_of(const RadiusArc& arc, double tolerance);

struct CenterArc {
  Point start;
  Point end;
  Point center;
  bool is_clockwise = false;
};
/// Degrees traveled, in (0, 360]; 360 when start and end are the same.
double sweep_of(const CenterArc& arc);

}  // namespace dripline::interpreter::centurion
