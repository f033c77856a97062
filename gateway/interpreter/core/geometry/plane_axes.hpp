#pragma once

#include <array>

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

}  // namespace dripline::interpreter
