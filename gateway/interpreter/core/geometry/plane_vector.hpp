#pragma once

#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter {

/// A point or a direction in a plane: along its first and second axis (`PlaneAxes`), in
/// millimeters or, where it is a direction, of length 1.
struct PlaneVector {
  double first = 0;
  double second = 0;

  friend PlaneVector operator+(PlaneVector a, PlaneVector b) {
    return {a.first + b.first, a.second + b.second};
  }
  friend PlaneVector operator-(PlaneVector a, PlaneVector b) {
    return {a.first - b.first, a.second - b.second};
  }
  friend PlaneVector operator-(PlaneVector a) { return {-a.first, -a.second}; }
  friend PlaneVector operator*(double k, PlaneVector a) { return {k * a.first, k * a.second}; }
  friend bool operator==(PlaneVector, PlaneVector) = default;
};

inline double dot(PlaneVector a, PlaneVector b) {
  return a.first * b.first + a.second * b.second;
}
/// Positive when the turn from `a` to `b` is to the left.
inline double cross(PlaneVector a, PlaneVector b) {
  return a.first * b.second - a.second * b.first;
}
inline double length(PlaneVector a) {
  return std::sqrt(dot(a, a));
}
/// A quarter turn to the left.
inline PlaneVector left_of(PlaneVector a) {
  return {-a.second, a.first};
}
/// The turn from `a` to `b` in radians, in (-pi, pi].
inline double turn_between(PlaneVector a, PlaneVector b) {
  return std::atan2(cross(a, b), dot(a, b));
}

inline PlaneVector in_plane(const Position& at, const PlaneAxes& axes) {
  return {at.raw(axes.first), at.raw(axes.second)};
}
inline void set_in_plane(Position& at, const PlaneAxes& axes, PlaneVector to) {
  at.set_raw(axes.first, to.first);
  at.set_raw(axes.second, to.second);
}

}  // namespace dripline::interpreter
