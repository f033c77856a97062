#include "gateway/interpreter/stages/blending/impl/corner.hpp"

#include <cmath>

namespace dripline::interpreter::blending::impl {

namespace {

/// Directions that differ by less go straight on: a rounding would be shorter than a thousandth of
/// a micrometer on every radius below a millimeter.
constexpr double kStraight = 1e-6;
/// Rounding may make a corner take this much more of an element than there is.
constexpr double kFits = 1e-6;

struct Turning {
  PlaneVector out, in;  ///< of length 1: where the first element leaves, the second one arrives
  double sine = cross(out, in);
  double cosine = dot(out, in);

  bool is_straight() const { return std::fabs(sine) < kStraight; }
  double side() const { return sine > 0 ? 1 : -1; }
};

Corner refusal(FaultKind kind, double value = 0, double limit = -1) {
  Corner corner;
  corner.fault = kind;
  corner.value = value;
  corner.limit = limit;
  return corner;
}

/// The curve of an element at `corner`, moved sideways by `offset` to the left; relative to the
/// corner. A circle whose radius this eats up is none.
struct Neighbor {
  const Element& element;
  PlaneVector corner;
  PlaneVector direction;
  double offset;

  PlaneLine line() const { return {direction, offset}; }
  PlaneCircle circle() const { return {element.center - corner, radius()}; }
  double radius() const { return length(corner - element.center) - element.side * offset; }
  /// Where a circle about `center`, which lies on the moved curve, touches the element.
  PlaneVector touched_from(PlaneVector center) const {
    if (!element.is_arc) return center - offset * left_of(direction);
    const PlaneVector middle = element.center - corner;
    const PlaneVector out = center - middle;
    return middle + (length(middle) / length(out)) * out;
  }
};

std::optional<PlaneVector> center_between(const Neighbor& a, const Neighbor& b) {
  if ((a.element.is_arc && a.radius() <= 0) || (b.element.is_arc && b.radius() <= 0))
    return std::nullopt;
  if (!a.element.is_arc && !b.element.is_arc) return meet(a.line(), b.line());
  const auto points = a.element.is_arc && b.element.is_arc ? meet(a.circle(), b.circle())
                      : a.element.is_arc                   ? meet(b.line(), a.circle())
                                                           : meet(a.line(), b.circle());
  if (!points) return std::nullopt;
  return points->nearest({});
}

double sweep_about(PlaneVector center, PlaneVector from, PlaneVector to, double side) {
  double sweep = turn_between(from - center, to - center);
  if (sweep * side < 0) sweep += side * 2 * Angle::kPi;
  return sweep;
}

Corner rounded(double radius, const Policy& policy, const Element& first, const Element& second) {
  const PlaneVector at = first.end;
  const Turning turn{first.direction_out(), second.direction_in()};
  if (turn.is_straight()) {
    if (turn.cosine > 0 && !policy.refuses_straight_corner) return {};
    return refusal(FaultKind::Straight);
  }
  const double offset = turn.side() * radius;
  const Neighbor a{first, at, turn.out, offset};
  const Neighbor b{second, at, turn.in, offset};
  const auto center = center_between(a, b);
  if (!center) return refusal(FaultKind::DoesNotFit, radius);
  Corner corner;
  corner.is_piece = corner.is_arc = true;
  const PlaneVector leave = a.touched_from(*center);
  const PlaneVector arrive = b.touched_from(*center);
  corner.sweep = sweep_about(*center, leave, arrive, turn.side());
  corner.center = at + *center;
  corner.leave = at + leave;
  corner.arrive = at + arrive;
  return corner;
}

Corner chamfered(const CornerShape& shape, const Element& first, const Element& second) {
  if (first.is_arc || second.is_arc) return refusal(FaultKind::ChamferAtArc);
  const Turning turn{first.direction_out(), second.direction_in()};
  if (turn.is_straight()) return turn.cosine > 0 ? Corner{} : refusal(FaultKind::Straight);
  // face = leg * |out + in|
  const double leg = shape.kind == CornerShape::Kind::ChamferLeg
                         ? shape.size
                         : shape.size / length(turn.out + turn.in);
  Corner corner;
  corner.is_piece = true;
  corner.leave = first.end - leg * turn.out;
  corner.arrive = second.from + leg * turn.in;
  return corner;
}

/// How much of an element lies between its corner and `point`; negative on the wrong side.
double taken_from_end(const Element& element, PlaneVector point) {
  if (!element.is_arc) return dot(element.end - point, element.direction_out());
  return element.side * turn_between(point - element.center, element.end - element.center);
}
double taken_from_start(const Element& element, PlaneVector point) {
  if (!element.is_arc) return dot(point - element.from, element.direction_in());
  return element.side * turn_between(element.from - element.center, point - element.center);
}

/// `taken` and what there is, as lengths.
bool fits(const Element& element, double taken, Corner& corner) {
  const double scale = element.is_arc ? length(element.end - element.center) : 1;
  const double size = element.is_arc ? element.sweep : length(element.end - element.from);
  if (taken * scale >= -kFits && (taken - size) * scale <= kFits) return true;
  corner = refusal(FaultKind::DoesNotFit, std::fabs(taken) * scale, size * scale);
  return false;
}

}  // namespace

Corner shape_corner(const CornerShape& shape, const Policy& policy, Element& first,
                    Element& second) {
  Corner corner = shape.kind == CornerShape::Kind::Round
                      ? rounded(shape.size, policy, first, second)
                      : chamfered(shape, first, second);
  if (corner.fault || !corner.is_piece) return corner;
  const double from_first = taken_from_end(first, corner.leave);
  const double from_second = taken_from_start(second, corner.arrive);
  if (!fits(first, from_first, corner) || !fits(second, from_second, corner)) return corner;
  first.end = corner.leave;
  second.from = corner.arrive;
  first.is_moved = second.is_moved = true;
  first.sweep -= from_first;
  second.sweep -= from_second;
  return corner;
}

namespace {

/// Millimeters; farther out, or where numbers end, nothing meets.
constexpr double kFarthest = 1e9;

Blend at_point(PlaneVector point) {
  return {.at = point, .fault = {}};
}
Blend no_blend(FaultKind kind) {
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
    return point ? at_point(corner + *point) : no_blend(FaultKind::NoIntersection);
  }
  const auto points = meet(line, circle_of(first, corner));
  if (!points) return no_blend(FaultKind::NoIntersection);
  return at_point(corner +
                  (back.which == Back::Nearest ? points->nearest(end) : points->farthest(end)));
}

/// A line through the corner and `anchor`, its other end; where it misses the circle it is turned
/// about the anchor until it touches.
Blend line_and_arc(PlaneVector anchor, const Element& arc, PlaneVector corner) {
  const PlaneCircle circle = circle_of(arc, corner);
  const PlaneVector along = anchor - corner;
  if (length(along) <= kNoLength) return no_blend(FaultKind::NoIntersection);
  const PlaneLine line = line_through({}, (1 / length(along)) * along);
  auto points = meet(line, circle);
  if (!points) points = touching_points(circle, along);
  return points ? at_point(corner + points->nearest({})) : no_blend(FaultKind::NoIntersection);
}

Blend arc_and_arc(const Element& first, const Element& second, PlaneVector corner) {
  const auto points = meet(circle_of(first, corner), circle_of(second, corner));
  return points ? at_point(corner + points->nearest({})) : no_blend(FaultKind::ArcsApart);
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
  return is_near ? blend : no_blend(FaultKind::NoIntersection);
}

}  // namespace dripline::interpreter::blending::impl
