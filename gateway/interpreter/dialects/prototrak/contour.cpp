#include "gateway/interpreter/dialects/prototrak/contour.hpp"

#include <cmath>
#include <vector>

#include "protocol/base/units.hpp"

namespace dripline::interpreter::prototrak {
namespace {

XY operator+(XY a, XY b) {
  return {a.x + b.x, a.y + b.y};
}
XY operator-(XY a, XY b) {
  return {a.x - b.x, a.y - b.y};
}
XY operator*(double k, XY a) {
  return {k * a.x, k * a.y};
}
double dot(XY a, XY b) {
  return a.x * b.x + a.y * b.y;
}
double cross(XY a, XY b) {
  return a.x * b.y - a.y * b.x;
}
XY left_of(XY direction) {
  return {-direction.y, direction.x};
}
XY unit(XY a) {
  const double length = std::hypot(a.x, a.y);
  return length > 0 ? (1 / length) * a : XY{};
}

XY direction_on_arc(const Element& arc, XY at) {
  const XY outward = unit(at - arc.center);
  return arc.is_counterclockwise ? left_of(outward) : -1 * left_of(outward);
}

/// The endless line or the circle an element lies on, moved sideways.
struct Curve {
  bool is_circle = false;
  XY point, direction;  ///< of a line
  XY center;
  double radius = 0;
};

/// To the left when `by` is positive. nullopt: a circle would have no radius left.
std::optional<Curve> moved(const Element& element, double by) {
  Curve curve;
  curve.is_circle = element.is_arc;
  if (!element.is_arc) {
    curve.direction = direction_at_start(element);
    curve.point = element.from + by * left_of(curve.direction);
    return curve;
  }
  curve.center = element.center;
  curve.radius = element.radius + (element.is_counterclockwise ? -by : by);
  if (curve.radius <= kNoise) return std::nullopt;
  return curve;
}

using Points = std::vector<XY>;

Points meet_lines(const Curve& a, const Curve& b) {
  const double sine = cross(a.direction, b.direction);
  if (std::fabs(sine) < 1e-12) return {};
  return {a.point + (cross(b.point - a.point, b.direction) / sine) * a.direction};
}

Points meet_line_and_circle(const Curve& line, const Curve& circle) {
  const double along = dot(circle.center - line.point, line.direction);
  const XY foot = line.point + along * line.direction;
  const double away = distance(foot, circle.center);
  if (away > circle.radius + kNoise) return {};
  const double half = std::sqrt(std::max(0.0, circle.radius * circle.radius - away * away));
  return {foot - half * line.direction, foot + half * line.direction};
}

Points meet_circles(const Curve& a, const Curve& b) {
  const double apart = distance(a.center, b.center);
  if (apart < kNoise) return {};
  const double along = (apart * apart + a.radius * a.radius - b.radius * b.radius) / (2 * apart);
  const double square = a.radius * a.radius - along * along;
  if (square < -kNoise) return {};
  const XY axis = unit(b.center - a.center);
  const XY foot = a.center + along * axis;
  const XY aside = std::sqrt(std::max(0.0, square)) * left_of(axis);
  return {foot - aside, foot + aside};
}

Points meet(const Curve& a, const Curve& b) {
  if (!a.is_circle && !b.is_circle) return meet_lines(a, b);
  if (a.is_circle && b.is_circle) return meet_circles(a, b);
  return a.is_circle ? meet_line_and_circle(b, a) : meet_line_and_circle(a, b);
}

/// Where a circle about `center` touches the element.
XY touch(const Element& element, XY center) {
  if (element.is_arc) {
    return element.center + element.radius * unit(center - element.center);
  }
  const XY direction = direction_at_start(element);
  return element.from + dot(center - element.from, direction) * direction;
}

/// The angle from the arc's begin to a point on it, in its own direction, 0 to 2 pi.
double angle_along(const Element& arc, XY at) {
  const XY from = arc.from - arc.center;
  const XY to = at - arc.center;
  double angle = std::atan2(cross(from, to), dot(from, to));
  if (!arc.is_counterclockwise) angle = -angle;
  constexpr double kFull = 2 * Angle::kPi;
  return angle < -1e-9 ? angle + kFull : std::max(angle, 0.0);
}

bool lies_within(const Element& element, XY at) {
  constexpr double kTolerance = 1e-6;  ///< mm, or of a turn
  if (element.is_arc) {
    const double sweep = distance(element.from, element.to) < kNoise
                             ? 2 * Angle::kPi
                             : angle_along(element, element.to);
    return angle_along(element, at) <= sweep + kTolerance;
  }
  const double along = dot(at - element.from, direction_at_start(element));
  return along >= -kTolerance && along <= distance(element.from, element.to) + kTolerance;
}

}  // namespace

Element element_of(const ProgramEvent& cut) {
  return {cut.kind == EventKind::Arc, cut.begin, cut.end, cut.center, cut.radius,
          cut.is_counterclockwise};
}

double distance(XY a, XY b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double join_tolerance(bool is_metric) {
  return is_metric ? 0.01 : 0.0001 * Length::kMillimetersPerInch;
}

XY direction_at_start(const Element& element) {
  if (element.is_arc) return direction_on_arc(element, element.from);
  return unit(element.to - element.from);
}

XY direction_at_end(const Element& element) {
  if (element.is_arc) return direction_on_arc(element, element.to);
  return unit(element.to - element.from);
}

XY beside(XY at, XY direction, double by) {
  return at + by * left_of(direction);
}

double turn_at(const Element& first, const Element& second) {
  return cross(direction_at_end(first), direction_at_start(second));
}

std::optional<Element> conrad(const Element& first, const Element& second, double radius) {
  const double turn = turn_at(first, second);
  const double inside = turn > 0 ? radius : -radius;
  const auto a = moved(first, inside);
  const auto b = moved(second, inside);
  if (!a || !b) return std::nullopt;
  std::optional<Element> found;
  double nearest = 0;
  for (const XY center : meet(*a, *b)) {
    const double away = distance(center, first.to);
    if (found && away >= nearest) continue;
    const Element arc{true, touch(first, center), touch(second, center), center, radius, turn > 0};
    if (!lies_within(first, arc.from) || !lies_within(second, arc.to)) continue;
    found = arc;
    nearest = away;
  }
  return found;
}

}  // namespace dripline::interpreter::prototrak
