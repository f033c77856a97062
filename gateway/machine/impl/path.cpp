#include "gateway/machine/impl/path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::machine::impl {

using interpreter::Axis;
using interpreter::kAxisCount;

namespace {

constexpr double kPi = Angle::kPi;

bool is_rotary_axis(std::size_t axis) {
  return interpreter::is_rotary(static_cast<Axis>(axis));
}

/// Path length of the linear axes; without linear motion, of the rotary axes.
double travel(const Coordinates& from, const Coordinates& to) {
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const double change = to[i] - from[i];
    (is_rotary_axis(i) ? rotary : linear) += change * change;
  }
  return std::sqrt(linear != 0 ? linear : rotary);  // NaN stays NaN
}

double arc_length_in_plane(const Circle& circle) {
  return std::fabs(circle.sweep) * (circle.radius + circle.radius_change / 2);
}

/// Distance between the end of this turn and the programmed end, as a share of the circle.
double miss(double start, double sweep, double end) {
  return std::fabs(std::remainder(start + sweep - end, 2 * kPi));
}

}  // namespace

void take_over(Coordinates& point, const interpreter::Position& position) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (!position.has(axis)) continue;
    point[i] = is_rotary_axis(i) ? position.rotary(axis).degrees() : position.linear(axis).mm();
  }
}

interpreter::Position to_position(const Coordinates& point, const interpreter::Position& axes_of) {
  interpreter::Position position;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (!axes_of.has(axis)) continue;
    if (is_rotary_axis(i))
      position.set(axis, Angle::degrees(point[i]));
    else
      position.set(axis, Length::mm(point[i]));
  }
  return position;
}

Coordinates Path::at(double distance) const {
  if (distance <= 0) return from;
  if (distance >= length) return to;
  const double part = distance / length;
  Coordinates point;
  for (std::size_t i = 0; i < kAxisCount; ++i) point[i] = from[i] + (to[i] - from[i]) * part;
  if (is_arc()) {
    const double angle = circle.start + circle.sweep * part;
    const double radius = circle.radius + circle.radius_change * part;
    point[circle.first] = circle.center_first + radius * std::cos(angle);
    point[circle.second] = circle.center_second + radius * std::sin(angle);
  }
  return point;
}

namespace {

Coordinates direction(const Path& path, double angle, double radius) {
  Coordinates change;
  for (std::size_t i = 0; i < kAxisCount; ++i)
    change[i] = (path.to[i] - path.from[i]) / path.length;
  if (path.is_arc()) {
    const double turn = path.circle.sweep * radius / path.length;
    change[path.circle.first] = -std::sin(angle) * turn;
    change[path.circle.second] = std::cos(angle) * turn;
  }
  return change;
}

}  // namespace

Coordinates Path::direction_at_start() const {
  return direction(*this, circle.start, circle.radius);
}

Coordinates Path::direction_at_end() const {
  return direction(*this, circle.start + circle.sweep, circle.radius + circle.radius_change);
}

double Path::share(std::size_t axis) const {
  if (is_arc() && (axis == circle.first || axis == circle.second))
    return arc_length_in_plane(circle) / length;
  return std::fabs(to[axis] - from[axis]) / length;
}

double Path::part_of_all_axes() const {
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < kAxisCount; ++i)
    (is_rotary_axis(i) ? rotary : linear) += (to[i] - from[i]) * (to[i] - from[i]);
  if (rotary == 0 || (linear == 0 && !is_arc())) return 1;
  return length / std::hypot(length, std::sqrt(rotary));
}

Range Path::range(std::size_t axis) const {
  Range range{std::min(from[axis], to[axis]), std::max(from[axis], to[axis])};
  if (!is_arc() || (axis != circle.first && axis != circle.second)) return range;
  // The extremes are at angles k * 180 degrees from the axis' own direction.
  const double own = axis == circle.first ? 0 : kPi / 2;
  const double center = axis == circle.first ? circle.center_first : circle.center_second;
  const double low = std::min(circle.start, circle.start + circle.sweep);
  const double high = std::max(circle.start, circle.start + circle.sweep);
  const double radius = std::max(circle.radius, circle.radius + circle.radius_change);
  double k = std::ceil((low - own) / kPi);
  for (int i = 0; i < 2 && own + k * kPi <= high; ++i, ++k) {
    const double extreme = center + radius * std::cos(k * kPi);
    range.low = std::min(range.low, extreme);
    range.high = std::max(range.high, extreme);
  }
  return range;
}

Path straight_path(const Coordinates& from, const Coordinates& to) {
  Path path;
  path.from = from;
  path.to = to;
  path.length = travel(from, to);
  return path;
}

Path arc_path(const Coordinates& from, const interpreter::Arc& arc) {
  Path path;
  path.from = from;
  path.to = from;
  take_over(path.to, arc.to);
  Circle& circle = path.circle;
  const auto axes = interpreter::axes_of(arc.plane);
  circle.first = static_cast<std::size_t>(axes.first);
  circle.second = static_cast<std::size_t>(axes.second);
  circle.center_first = arc.center_first.mm();
  circle.center_second = arc.center_second.mm();
  const auto polar = [&circle](const Coordinates& point) {
    const double x = point[circle.first] - circle.center_first;
    const double y = point[circle.second] - circle.center_second;
    return std::pair{std::hypot(x, y), std::atan2(y, x)};
  };
  const auto [radius, start] = polar(path.from);
  const auto [end_radius, end] = polar(path.to);
  circle.radius = radius;
  circle.radius_change = end_radius - radius;
  circle.start = start;
  const double sweep = arc.sweep.radians();
  const double as_said = arc.turn == interpreter::Turn::Counterclockwise ? sweep : -sweep;
  // Some lathe manuals draw X downwards, which exchanges the two directions.
  const bool other = miss(start, -as_said, end) + 1e-6 < miss(start, as_said, end);
  circle.sweep = other ? -as_said : as_said;

  Coordinates beside = path.to;  // the travel of the axes that are not in the plane
  beside[circle.first] = path.from[circle.first];
  beside[circle.second] = path.from[circle.second];
  path.length = arc_length_in_plane(circle);
  if (path.length > 0 && beside != path.from)
    path.length = std::hypot(path.length, straight_path(path.from, beside).length);
  return path;
}

}  // namespace dripline::machine::impl
