#pragma once

#include <array>
#include <cmath>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// The axes of a plane in right-handed order: a counterclockwise arc runs from `first` to `second`;
/// `normal` is the axis a helix rises along.
struct PlaneAxes {
  Axis first, second, normal;
};

/// In the order of `Plane`.
inline constexpr std::array kAxesOfPlanes{PlaneAxes{Axis::X, Axis::Y, Axis::Z},
                                          PlaneAxes{Axis::Z, Axis::X, Axis::Y},
                                          PlaneAxes{Axis::Y, Axis::Z, Axis::X}};
constexpr PlaneAxes axes_of(Plane plane) {
  const PlaneAxes& axes = kAxesOfPlanes[static_cast<std::size_t>(plane)];
  return {axes.first, axes.second, axes.normal};
}

/// The plane across X, Y or Z.
constexpr Plane plane_across(Axis normal) {
  if (normal == Axis::X) return Plane::YZ;
  return normal == Axis::Y ? Plane::ZX : Plane::XY;
}

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
