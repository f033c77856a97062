#include "gateway/interpreter/compensation/impl/intersection.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::interpreter::compensation::impl {
namespace {

/// Curves apart by this share of their size touch.
constexpr double kTouch = 1e-9;
/// Directions and centres nearer to each other than this do not give a point.
constexpr double kParallel = 1e-12;

/// All below is relative to the corner, so that far-off coordinates cost no digits.
struct OffsetLine {
  PlaneVector direction, normal;
  double offset;
};
struct OffsetCircle {
  PlaneVector center;
  double radius;
};

PlaneVector nearer(PlaneVector a, PlaneVector b) {
  return dot(a, a) <= dot(b, b) ? a : b;
}

/// Half the chord that a line at `distance` cuts out of a circle; nothing when it misses.
std::optional<double> half_chord(double radius, double distance, double size) {
  const double miss = std::fabs(distance) - radius;
  if (miss > kTouch * size) return std::nullopt;
  return miss >= 0 ? 0 : std::sqrt(-miss * (radius + std::fabs(distance)));
}

/// How far along `a` from its own normal the other line is. The half angle keeps the digits of a
/// small turn.
double reach(const OffsetLine& a, const OffsetLine& b) {
  const double sine = cross(a.direction, b.direction);
  const double cosine = dot(a.direction, b.direction);
  if (cosine < 0) return (a.offset * cosine - b.offset) / sine;
  return (a.offset - b.offset) / sine - a.offset * sine / (1 + cosine);
}

PlaneVector crossing(const OffsetLine& a, const OffsetLine& b) {
  return a.offset * a.normal + reach(a, b) * a.direction;
}

std::optional<PlaneVector> meet(const OffsetLine& a, const OffsetLine& b) {
  if (std::fabs(cross(a.direction, b.direction)) < kParallel) return std::nullopt;
  return crossing(a, b);
}

std::optional<PlaneVector> meet(const OffsetLine& line, const OffsetCircle& circle) {
  const double distance = line.offset - dot(circle.center, line.normal);
  const auto half = half_chord(circle.radius, distance, circle.radius + length(circle.center));
  if (!half) return std::nullopt;
  const PlaneVector foot = circle.center + distance * line.normal;
  return nearer(foot + *half * line.direction, foot - *half * line.direction);
}

std::optional<PlaneVector> meet(const OffsetCircle& a, const OffsetCircle& b) {
  const PlaneVector between = b.center - a.center;
  const double apart = length(between);
  if (apart < kParallel * (a.radius + b.radius)) return std::nullopt;
  const PlaneVector along = (1 / apart) * between;
  // (a.radius - b.radius) first: squares of two large radii would lose their difference
  const double difference = (a.radius - b.radius) * (a.radius + b.radius);
  const double reach = 0.5 * (apart + difference / apart);
  const auto half = half_chord(a.radius, reach, a.radius + b.radius + apart);
  if (!half) return std::nullopt;
  const PlaneVector foot = a.center + reach * along;
  return nearer(foot + *half * left_of(along), foot - *half * left_of(along));
}

OffsetLine line_at_end(const Element& element) {
  return {element.direction_out, element.normal_out(), element.offset};
}
OffsetLine line_at_start(const Element& element) {
  return {element.direction_in, element.normal_in(), element.offset};
}
OffsetCircle circle_at_end(const Element& element) {
  return {element.arch.center - element.end, std::max(0.0, element.offset_radius_out())};
}
OffsetCircle circle_at_start(const Element& element) {
  return {element.arch.center - element.from, std::max(0.0, element.offset_radius_in())};
}

std::optional<PlaneVector> meet_at_corner(const Element& first, const Element& second) {
  if (first.is_arc && second.is_arc) return meet(circle_at_end(first), circle_at_start(second));
  if (first.is_arc) return meet(line_at_start(second), circle_at_end(first));
  if (second.is_arc) return meet(line_at_end(first), circle_at_start(second));
  return meet(line_at_end(first), line_at_start(second));
}

}  // namespace

std::optional<PlaneVector> meet(const Element& first, const Element& second) {
  const auto point = meet_at_corner(first, second);
  if (!point) return std::nullopt;
  return first.end + *point;
}

PlaneVector tangents_meet(const Element& first, const Element& second) {
  return first.end + crossing(line_at_end(first), line_at_start(second));
}

}  // namespace dripline::interpreter::compensation::impl
