#include "gateway/interpreter/core/geometry/plane_curves.hpp"

#include <cmath>

namespace dripline::interpreter {
namespace {

/// Curves apart by this share of their size touch.
constexpr double kTouch = 1e-9;
/// Directions and centers nearer to each other than this do not give a point.
constexpr double kParallel = 1e-12;

/// Half the chord that a line at `distance` cuts out of a circle; nothing when it misses.
std::optional<double> half_chord(double radius, double distance, double size) {
  const double miss = std::fabs(distance) - radius;
  if (miss > kTouch * size) return std::nullopt;
  return miss >= 0 ? 0 : std::sqrt(-miss * (radius + std::fabs(distance)));
}

/// How far along `a` from its foot the other line is. The half angle keeps the digits of a small
/// turn.
double reach(const PlaneLine& a, const PlaneLine& b) {
  const double sine = cross(a.direction, b.direction);
  const double cosine = dot(a.direction, b.direction);
  if (cosine < 0) return (a.offset * cosine - b.offset) / sine;
  return (a.offset - b.offset) / sine - a.offset * sine / (1 + cosine);
}

bool is_nearer(PlaneVector to, PlaneVector a, PlaneVector b) {
  return dot(a - to, a - to) <= dot(b - to, b - to);
}

}  // namespace

PlaneLine line_through(PlaneVector point, PlaneVector direction) {
  return {direction, dot(point, left_of(direction))};
}

PlaneVector PointPair::nearest(PlaneVector to) const {
  return is_nearer(to, one, other) ? one : other;
}
PlaneVector PointPair::farthest(PlaneVector from) const {
  return is_nearer(from, one, other) ? other : one;
}

PlaneVector crossing(const PlaneLine& a, const PlaneLine& b) {
  return a.foot() + reach(a, b) * a.direction;
}

std::optional<PlaneVector> meet(const PlaneLine& a, const PlaneLine& b) {
  if (std::fabs(cross(a.direction, b.direction)) < kParallel) return std::nullopt;
  return crossing(a, b);
}

std::optional<PointPair> meet(const PlaneLine& line, const PlaneCircle& circle) {
  const double distance = line.offset - dot(circle.center, line.normal());
  const auto half = half_chord(circle.radius, distance, circle.radius + length(circle.center));
  if (!half) return std::nullopt;
  const PlaneVector foot = circle.center + distance * line.normal();
  return PointPair{foot + *half * line.direction, foot - *half * line.direction};
}

std::optional<PointPair> meet(const PlaneCircle& a, const PlaneCircle& b) {
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
  return PointPair{foot + *half * left_of(along), foot - *half * left_of(along)};
}

std::optional<PointPair> touching_points(const PlaneCircle& circle, PlaneVector point) {
  const PlaneVector out = point - circle.center;
  const double distance = length(out);
  if (distance < circle.radius || distance == 0) return std::nullopt;
  const PlaneVector along = (1 / distance) * out;
  const double cosine = circle.radius / distance;
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const PlaneVector foot = circle.center + circle.radius * cosine * along;
  const PlaneVector aside = circle.radius * sine * left_of(along);
  return PointPair{foot + aside, foot - aside};
}

}  // namespace dripline::interpreter
