#include "gateway/interpreter/stages/blending/impl/blend.hpp"

#include <cmath>

namespace dripline::interpreter::blending::impl {
namespace {

/// Millimeters; farther out, or where numbers end, nothing meets.
constexpr double kFarthest = 1e9;

Blend at_point(PlaneVector point) {
  return {.at = point, .fault = {}};
}
Blend refusal(FaultKind kind) {
  return {.at = {}, .fault = kind};
}

/// All geometry below is relative to the programmed corner.
PlaneCircle circle_of(const Element& arc, PlaneVector corner) {
  return {arc.center - corner, arc.radius_at(corner)};
}

double off_circle(const Element& arc, PlaneVector point) {
  return std::fabs(length(point - arc.center) - arc.radius_at(point));
}
bool is_on(const Element& element, PlaneVector point) {
  return !element.is_arc || !element.announced.estimate ||
         off_circle(element, point) <= element.announced.estimate->tolerance;
}

Blend led_back(const Element& first, const Element& second) {
  const PlaneVector corner = first.end;
  const LeadBack& back = *second.announced.back;
  const PlaneVector end = second.end - corner;
  const PlaneLine line = line_through(end, back.direction);
  if (!first.is_arc) {
    const auto point = meet(line_through({}, first.direction_out()), line);
    return point ? at_point(corner + *point) : refusal(FaultKind::NoIntersection);
  }
  const auto points = meet(line, circle_of(first, corner));
  if (!points) return refusal(FaultKind::NoIntersection);
  return at_point(corner +
                  (back.which == Back::Nearest ? points->nearest(end) : points->farthest(end)));
}

/// A line through the corner and `anchor`, its other end; where it misses the circle it is turned
/// about the anchor until it touches.
Blend line_and_arc(PlaneVector anchor, const Element& arc, PlaneVector corner) {
  const PlaneCircle circle = circle_of(arc, corner);
  const PlaneVector along = anchor - corner;
  if (length(along) <= kNoLength) return refusal(FaultKind::NoIntersection);
  const PlaneLine line = line_through({}, (1 / length(along)) * along);
  auto points = meet(line, circle);
  if (!points) points = touching_points(circle, along);
  return points ? at_point(corner + points->nearest({})) : refusal(FaultKind::NoIntersection);
}

Blend arc_and_arc(const Element& first, const Element& second, PlaneVector corner) {
  const auto points = meet(circle_of(first, corner), circle_of(second, corner));
  return points ? at_point(corner + points->nearest({})) : refusal(FaultKind::ArcsApart);
}

Blend estimated(const Element& first, const Element& second) {
  const PlaneVector corner = first.end;
  if (is_on(first, corner) && is_on(second, corner)) return at_point(corner);
  if (first.is_arc && second.is_arc) return arc_and_arc(first, second, corner);
  if (first.is_arc) return line_and_arc(second.end, first, corner);
  return line_and_arc(first.from, second, corner);
}

}  // namespace

Blend blend_on(const Element& element, PlaneVector point) {
  Blend blend = at_point(point);
  if (is_on(element, point)) return blend;
  blend.fault = FaultKind::OffArc;
  blend.off_by = off_circle(element, point);
  blend.radius = element.radius_at(point);
  return blend;
}

namespace {

Blend decided(const Element& first, const Element& second) {
  if (second.announced.back) return led_back(first, second);
  if (!first.is_arc && !second.is_arc) return at_point(first.end);
  if (first.announced.estimate && second.announced.estimate) return estimated(first, second);
  Blend blend = blend_on(first, first.end);
  return blend.fault ? blend : blend_on(second, first.end);
}

}  // namespace

Blend blend_of(const Element& first, const Element& second) {
  const Blend blend = decided(first, second);
  if (blend.fault) return blend;
  const bool is_near =
      std::fabs(blend.at.first) <= kFarthest && std::fabs(blend.at.second) <= kFarthest;
  return is_near ? blend : refusal(FaultKind::NoIntersection);
}

}  // namespace dripline::interpreter::blending::impl
