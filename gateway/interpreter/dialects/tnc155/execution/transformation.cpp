#include "gateway/interpreter/dialects/tnc155/execution/transformation.hpp"

#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// Exact at multiples of 90 degrees.
PlaneVector direction(double degrees) {
  const double quarter = degrees / 90;
  if (quarter == std::floor(quarter)) {
    const int quarters = static_cast<int>(std::fmod(quarter, 4));
    constexpr PlaneVector kQuarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return kQuarters[(quarters + 4) % 4];
  }
  const double radians = degrees * (Angle::kPi / 180);
  return {std::cos(radians), std::sin(radians)};
}

void rotate(Transformation::Values& point, Plane plane, double degrees) {
  if (degrees == 0) return;
  const PlaneAxes axes = axes_of(plane);
  const PlaneVector turn = direction(degrees);
  const double first = point[index(axes.first)];
  const double second = point[index(axes.second)];
  point[index(axes.first)] = first * turn.first - second * turn.second;
  point[index(axes.second)] = first * turn.second + second * turn.first;
}

}  // namespace

void Transformation::update() {
  is_special = basic_rotation != 0 || rotation != 0;
  for (std::size_t i = 0; i < 3; ++i) is_special |= mirrored[i] || (scaled[i] && scale != 1);
  for (std::size_t i = 0; i < kAxisCount; ++i) offset[i] = datum[i] + shift[i];
}

Transformation::Values Transformation::to_machine(Values point) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (scaled[i]) point[i] *= scale;
    if (mirrored[i]) point[i] = -point[i];
  }
  rotate(point, rotation_plane, rotation);
  for (std::size_t i = 0; i < kAxisCount; ++i) point[i] += shift[i];
  rotate(point, basic_plane, basic_rotation);
  for (std::size_t i = 0; i < kAxisCount; ++i) point[i] += datum[i];
  return point;
}

Transformation::Values Transformation::to_program(Values point) const {
  for (std::size_t i = 0; i < kAxisCount; ++i) point[i] -= datum[i];
  rotate(point, basic_plane, -basic_rotation);
  for (std::size_t i = 0; i < kAxisCount; ++i) point[i] -= shift[i];
  rotate(point, rotation_plane, -rotation);
  for (std::size_t i = 0; i < 3; ++i) {
    if (mirrored[i]) point[i] = -point[i];
    if (scaled[i]) point[i] /= scale;
  }
  return point;
}

bool Transformation::turns_over(Plane plane) const {
  const PlaneAxes axes = axes_of(plane);
  return mirrored[index(axes.first)] != mirrored[index(axes.second)];
}

double Transformation::factor(Axis axis) const {
  return axis <= Axis::Z && scaled[index(axis)] ? scale : 1;
}

double Transformation::factor(Plane plane) const {
  return factor(axes_of(plane).first);
}

bool Transformation::keeps_circles(Plane plane) const {
  const PlaneAxes axes = axes_of(plane);
  const auto keeps = [&](double degrees, Plane turned) {
    return turned == plane || std::fmod(degrees, 360) == 0;
  };
  return keeps(rotation, rotation_plane) && keeps(basic_rotation, basic_plane) &&
         factor(axes.first) == factor(axes.second);
}

void Transformation::cancel_cycles() {
  shift = {};
  mirrored = {};
  rotation = 0;
  scale = 1;
  scaled = {};
  update();
}

}  // namespace dripline::interpreter::tnc155
