#pragma once

#include <array>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter::tnc155 {

constexpr std::size_t index(Axis axis) {
  return static_cast<std::size_t>(axis);
}

/// From program coordinates to the machine's:
/// machine = datum + basic rotation of (shift + rotation of mirrored and scaled program
/// coordinates). Raw values: millimeters and degrees; index as in kAllAxes.
struct Transformation {
  using Values = std::array<double, kAxisCount>;

  Values datum{};             ///< set by hand or by the probe
  double basic_rotation = 0;  ///< of the probe: degrees, about the datum, in its plane
  Plane basic_plane = Plane::XY;

  Values shift{};                  ///< cycle 7
  std::array<bool, 3> mirrored{};  ///< cycle 8: X, Y, Z
  double rotation = 0;             ///< cycle 10: degrees
  Plane rotation_plane = Plane::XY;
  double scale = 1;              ///< cycle 11
  std::array<bool, 3> scaled{};  ///< X, Y, Z

  /// More than a shift. Derived: call `update` after every change.
  bool is_special = false;
  Values offset{};  ///< datum and shift, while not special
  void update();

  /// Of one axis, while not special.
  double to_machine(Axis axis, double value) const {
    return value + offset[static_cast<std::size_t>(axis)];
  }
  Values to_machine(Values point) const;
  Values to_program(Values point) const;
  /// Mirroring reverses the direction of arcs in this plane.
  bool turns_over(Plane plane) const;
  /// Of lengths along an axis.
  double factor(Axis axis) const;
  /// Of lengths in the plane.
  double factor(Plane plane) const;
  /// A circle in this plane is one in the same plane of the machine: no rotation in another plane
  /// tilts it, and both axes have the same scale.
  bool keeps_circles(Plane plane) const;
  /// Without the cycles; datum and basic rotation stay.
  void cancel_cycles();
};

}  // namespace dripline::interpreter::tnc155
