#include "gateway/interpreter/dialects/centurion/compensation/tangents.hpp"

#include <cmath>

namespace dripline::interpreter::centurion {
namespace {

/// Three points are on one line when the sine of the angle between them is no larger.
constexpr double kOneLine = 1e-12;

double sign(Beside side) {
  return static_cast<double>(side);
}

}  // namespace

std::optional<TangentPoints> tangent_points(const TangentLine& line) {
  const PlaneVector distance = line.second.center - line.first.center;
  const double apart = length(distance);
  if (apart == 0) return std::nullopt;
  const PlaneVector along = (1 / apart) * distance;
  const double first = sign(line.on_first) * line.first.radius;
  const double second = sign(line.on_second) * line.second.radius;
  const double cosine = (first - second) / apart;
  if (std::fabs(cosine) > 1) return std::nullopt;
  const PlaneVector normal =
      cosine * along + std::sqrt((1 - cosine) * (1 + cosine)) * left_of(along);
  return TangentPoints{
      line.first.center + first * normal, line.second.center + second * normal, {}};
}

std::optional<TangentPoints> tangent_points(const TangentArc& arc) {
  const PlaneVector distance = arc.second.center - arc.first.center;
  // a circle whose tangent point is on the side of the arc's center is outside the arc
  const double first = sign(arc.on_first) * sign(arc.center);
  const double second = sign(arc.on_second) * sign(arc.center);
  const PlaneCircle about_first{{}, arc.radius + first * arc.first.radius};
  const PlaneCircle about_second{distance, arc.radius + second * arc.second.radius};
  if (about_first.radius <= 0 || about_second.radius <= 0) return std::nullopt;
  const auto centers = meet(about_first, about_second);
  if (!centers) return std::nullopt;
  const bool is_left = cross(distance, centers->one) > 0;
  const PlaneVector center =
      is_left == (arc.center == Beside::Left) ? centers->one : centers->other;
  const PlaneVector to_second = center - distance;
  return TangentPoints{
      arc.first.center + (first * arc.first.radius / length(center)) * center,
      arc.second.center + (second * arc.second.radius / length(to_second)) * to_second,
      arc.first.center + center};
}

std::optional<CircleThrough> circle_through(const ThreePoints& points) {
  const PlaneVector a = points.second - points.first;
  const PlaneVector b = points.third - points.first;
  const double turn = cross(a, b);
  if (std::fabs(turn) <= kOneLine * length(a) * length(b)) return std::nullopt;
  const PlaneVector center = (0.5 / turn) * (dot(b, b) * left_of(a) - dot(a, a) * left_of(b));
  return CircleThrough{{points.first + center, length(center)}, turn > 0};
}

}  // namespace dripline::interpreter::centurion
