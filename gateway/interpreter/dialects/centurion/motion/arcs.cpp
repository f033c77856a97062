#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/language/expression.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr double kSamePoint = 1e-9;

double direction(const Point& from, const Point& to) {
  return std::atan2(to.x - from.x, to.z - from.z) * (180.0 / Angle::kPi);
}

}  // namespace

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.z - b.z);
}

Point polar(const Point& pole, double length, double degrees) {
  return {pole.x + length * language::sine(degrees).value,
          pole.z + length * language::cosine(degrees).value};
}

std::optional<Point> center_of(const RadiusArc& arc, double tolerance) {
  const double chord = distance(arc.start, arc.end);
  const double half = chord / 2;
  const double radius = std::fabs(arc.radius);
  if (half > radius + tolerance) return std::nullopt;
  const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
  // The center of a short counterclockwise arc is to the left of the path from start to end.
  const double side = (arc.radius > 0) == arc.is_clockwise ? -height : height;
  const double along_x = (arc.end.x - arc.start.x) / chord;
  const double along_z = (arc.end.z - arc.start.z) / chord;
  return Point{(arc.start.x + arc.end.x) / 2 + side * along_z,
               (arc.start.z + arc.end.z) / 2 - side * along_x};
}

double sweep_of(const CenterArc& arc) {
  if (distance(arc.start, arc.end) <= kSamePoint) return 360;
  double turn = direction(arc.center, arc.end) - direction(arc.center, arc.start);
  if (arc.is_clockwise) turn = -turn;
  while (turn <= 0) turn += 360;
  while (turn > 360) turn -= 360;
  return turn;
}

}  // namespace dripline::interpreter::centurion
