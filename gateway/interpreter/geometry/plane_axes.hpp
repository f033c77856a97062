#pragma once

#include "gateway/interpreter/event.hpp"

namespace dripline::interpreter {

/// The axes of a plane in right-handed order: an arc turns from `first` to `second`; `normal` is
/// the axis a helix rises along.
struct PlaneAxes {
  Axis first, second, normal;
};

constexpr PlaneAxes axes_of(Plane plane) {
  switch (plane) {
    case Plane::ZX:
      return {Axis::Z, Axis::X, Axis::Y};
    case Plane::YZ:
      return {Axis::Y, Axis::Z, Axis::X};
    case Plane::XY:
      break;
  }
  return {Axis::X, Axis::Y, Axis::Z};
}

/// The plane across X, Y or Z.
constexpr Plane plane_across(Axis normal) {
  if (normal == Axis::X) return Plane::YZ;
  return normal == Axis::Y ? Plane::ZX : Plane::XY;
}

}  // namespace dripline::interpreter
