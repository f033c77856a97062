#include "gateway/interpreter/stages/compensation/impl/corner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/geometry/plane_curves.hpp"

namespace dripline::interpreter::compensation::impl {

namespace {

enum class Shape { Straight, Inside, Outside };

/// Rounding of right angles does not make them sharper than a limit of 90 degrees.
constexpr double kSharpness = 1e-9;

struct Turning {
  Turning(const Element& first, const Element& second)
      : sine(cross(first.direction_out, second.direction_in)),
        cosine(dot(first.direction_out, second.direction_in)),
        bend(bend_of(first, first.arch.radius_out) + bend_of(second, second.arch.radius_in)) {}
  double sine, cosine;
  double bend;  ///< of both elements together, to the left

 private:
  static double bend_of(const Element& element, double radius) {
    return element.is_arc && radius > 0 ? element.arch.side / radius : 0;
  }
};

/// Where the path doubles back on itself, elements that bend away from the tool leave a valley; the
/// tool has to go round any others.
Shape shape_of(const Turning& turn, double offset, double tolerance) {
  if (std::fabs(turn.sine) <= tolerance) {
    if (turn.cosine > 0) return Shape::Straight;
    return turn.bend * offset < 0 ? Shape::Inside : Shape::Outside;
  }
  return (turn.sine < 0) == (offset > 0) ? Shape::Outside : Shape::Inside;
}

CornerEnd at_point(Element& second, PlaneVector point) {
  second.begin = point;
  return {point, {}};
}
CornerEnd refusal(FaultKind kind) {
  return {{}, kind};
}

/// The pieces between two elements, one after the other.
class CornerPath {
 public:
  CornerPath(PlaneVector from, Element& second) : at_(from), second_(second) {}
  void go_straight(PlaneVector to) {
    if (length(to - at_) > kNoLength)
      second_.lead_in.add({.is_arc = false, .to = to, .center = {}});
    at_ = to;
  }
  void round_corner(PlaneVector center, PlaneVector to, double sweep) {
    second_.lead_in.add({.is_arc = true, .to = to, .center = center, .sweep = sweep});
    at_ = to;
  }
  void arrive(PlaneVector begin) {
    second_.begin = begin;
    go_straight(begin);
  }
  PlaneVector at() const { return at_; }

 private:
  PlaneVector at_;
  Element& second_;
};

/// Each on its own normal, with a straight piece between.
CornerEnd normals_joined(const Element& first, Element& second) {
  const PlaneVector end = first.own_end();
  CornerPath(end, second).arrive(second.own_begin());
  return {end, {}};
}

CornerEnd intersection(const Element& first, Element& second) {
  const auto point = meet(first, second);
  return point ? at_point(second, *point) : refusal(FaultKind::NoIntersection);
}

CornerEnd extended(const Policy& policy, const Turning& turn, const Element& first,
                   Element& second) {
  const bool is_sharp = turn.cosine < std::cos(policy.sharpest.radians()) - kSharpness;
  const bool is_parallel = std::fabs(turn.sine) < kSharpness;
  PlaneVector leaving, arriving;
  if (is_sharp || is_parallel) {
    leaving = first.own_end() + std::fabs(first.offset) * first.direction_out;
    arriving = second.own_begin() - std::fabs(second.offset) * second.direction_in;
  } else {
    leaving = arriving = tangents_meet(first, second);
  }
  const PlaneVector end = first.is_arc ? first.own_end() : leaving;
  CornerPath path(end, second);
  path.go_straight(leaving);
  path.go_straight(arriving);
  path.arrive(second.is_arc ? second.own_begin() : arriving);
  return {end, {}};
}

/// Round `first.end` from the cutter's circle to the second's own normal.
void go_around(CornerPath& path, const Element& first, const Element& second) {
  const PlaneVector out = path.at() - first.end;
  const PlaneVector back = std::copysign(length(out), second.offset) * second.normal_in();
  double sweep = turn_between(out, back);
  if (std::fabs(sweep * second.offset) <= kNoLength) return path.go_straight(first.end + back);
  // away from the compensated side, whatever rounding makes of a half circle
  if ((sweep > 0) == (second.offset > 0)) sweep = -sweep;
  path.round_corner(first.end, first.end + back, sweep);
}

CornerEnd rounded(const Element& first, Element& second) {
  const PlaneVector end = first.own_end();
  CornerPath path(end, second);
  go_around(path, first, second);
  path.arrive(second.own_begin());
  return {end, {}};
}

CornerEnd outside_corner(const Policy& policy, const Turning& turn, const Element& first,
                         Element& second) {
  if (first.offset == 0) return at_point(second, first.end);
  switch (first.outside) {
    case OutsideCorner::IntersectCurves:
      return intersection(first, second);
    case OutsideCorner::Arc:
      if (!second.is_rapid || policy.rounds_at_rapid) return rounded(first, second);
      break;
    case OutsideCorner::ExtendTangents:
      break;
  }
  return extended(policy, turn, first, second);
}

/// Where the start-up line from `tool` touches the cutter's circle about its end, `distance` away.
PlaneVector touching_point(const Element& first, PlaneVector tool, double distance) {
  const PlaneVector out = (1 / distance) * (tool - first.end);
  const double radius = std::fabs(first.offset);
  const double cosine = radius / distance;
  const double sine = std::sqrt(1 - cosine * cosine) * (first.offset > 0 ? -1 : 1);
  return first.end + radius * (cosine * out + sine * left_of(out));
}

/// The line to `touch`, not the programmed one.
Element touching_line(const Element& first, PlaneVector tool, PlaneVector touch) {
  Element line = first;
  const PlaneVector along = touch - tool;
  line.direction_out = (1 / length(along)) * along;
  return line;
}

/// The tool follows the circle to the next element's normal.
CornerEnd tangential_start(const Policy& policy, const Element& first, Element& second,
                           PlaneVector tool) {
  if (first.offset == 0 || second.is_rapid) return at_point(second, second.own_begin());
  const double distance = length(tool - first.end);
  if (distance <= std::fabs(first.offset)) return refusal(FaultKind::StartUpTooClose);
  const PlaneVector touch = touching_point(first, tool, distance);
  const Turning turn(touching_line(first, tool, touch), second);
  const Shape shape = shape_of(turn, second.offset, policy.tangent_tolerance.radians());
  if (shape == Shape::Inside && policy.inside == InsideCorner::Refuse)
    return refusal(FaultKind::ConcaveCorner);
  if (shape != Shape::Outside) return at_point(second, second.own_begin());
  CornerPath path(touch, second);
  go_around(path, first, second);
  second.begin = second.own_begin();
  return {touch, {}};
}

/// An arc of `radius` that is tangent at `contour`, on the side of the tangent `along` on which
/// `away` lies, and the point from which it goes straight to or comes straight from there.
struct Approach {
  PlaneVector center, touch;
  double side = 1;  ///< of the turn: +1 to the left
};
std::optional<Approach> approach(PlaneVector contour, PlaneVector along, PlaneVector away,
                                 double radius, bool leaves) {
  Approach arc;
  arc.side = cross(along, away - contour) < 0 ? -1 : 1;
  arc.center = contour + arc.side * radius * left_of(along);
  const PlaneVector out = away - arc.center;
  const double distance = length(out);
  if (distance < radius) return std::nullopt;
  const PlaneVector direction = (1 / distance) * out;
  const double cosine = radius / distance;
  const double sine = std::sqrt(1 - cosine * cosine) * (leaves ? -arc.side : arc.side);
  arc.touch = arc.center + radius * (cosine * direction + sine * left_of(direction));
  return arc;
}

Piece approach_piece(const ByArc& by_arc, const Approach& arc, PlaneVector from, PlaneVector to) {
  double sweep = turn_between(from - arc.center, to - arc.center);
  if (sweep * arc.side < 0) sweep += arc.side * 2 * Angle::kPi;
  return {.is_arc = true, .to = to, .center = arc.center, .sweep = sweep, .origin = by_arc.origin};
}

/// On the tangent itself there is nothing to turn into.
bool is_on_tangent(PlaneVector contour, PlaneVector along, PlaneVector away, bool ahead) {
  const PlaneVector out = away - contour;
  return std::fabs(cross(along, out)) <= kNoLength && (dot(along, out) > 0) == ahead;
}

CornerEnd run_on(const Element& first, Element& second, PlaneVector tool) {
  const PlaneVector contour = second.own_begin();
  const PlaneVector along = second.direction_in;
  if (first.by_arc->radius == 0 || is_on_tangent(contour, along, tool, false))
    return at_point(second, contour);
  const auto arc = approach(contour, along, tool, first.by_arc->radius, false);
  if (!arc) return refusal(FaultKind::ArcTooLarge);
  second.begin = contour;
  if (length(contour - arc->touch) > kNoLength)
    second.lead_in.add(approach_piece(*first.by_arc, *arc, arc->touch, contour));
  return {arc->touch, {}};
}

CornerEnd run_off(const Element& first, Element& second) {
  const PlaneVector contour = first.own_end();
  const PlaneVector along = first.direction_out;
  if (second.by_arc->radius == 0 || is_on_tangent(contour, along, second.end, true))
    return at_point(second, contour);
  const auto arc = approach(contour, along, second.end, second.by_arc->radius, true);
  if (!arc) return refusal(FaultKind::ArcTooLarge);
  second.begin = arc->touch;
  if (length(contour - arc->touch) > kNoLength)
    second.lead_in.add(approach_piece(*second.by_arc, *arc, contour, arc->touch));
  return {contour, {}};
}

CornerEnd start_up_corner(const Policy& policy, const Element& first, Element& second,
                          PlaneVector tool) {
  if (second.role == Role::Cancel) return at_point(second, first.own_end());
  if (first.by_arc) return run_on(first, second, tool);
  if (first.start_up == StartUp::Tangent) return tangential_start(policy, first, second, tool);
  const Turning turn(first, second);
  const Shape shape = shape_of(turn, second.offset, policy.tangent_tolerance.radians());
  if (first.start_up == StartUp::Corner && shape == Shape::Outside)
    return outside_corner(policy, turn, first, second);
  return at_point(second, second.own_begin());
}

/// The cancel move is offset like the element before it, but ends where programmed.
CornerEnd cancel_corner(const Policy& policy, const Element& first, Element& second) {
  if (second.by_arc) return run_off(first, second);
  const Turning turn(first, second);
  const Shape shape = shape_of(turn, second.offset, policy.tangent_tolerance.radians());
  if (policy.cancel == Cancel::Corner && shape == Shape::Outside && first.role != Role::StartUp)
    return outside_corner(policy, turn, first, second);
  return at_point(second, first.own_end());
}

CornerEnd contour_corner(const Policy& policy, const Element& first, Element& second);

/// The tool changes to the other side where the two offset elements meet. Far from the corner that
/// is no change of side any more.
CornerEnd sides_crossed(const Policy& policy, const Element& first, Element& second) {
  constexpr double kFarthest = 2;  // radii
  const bool is_straight =
      !first.is_arc && !second.is_arc &&
      std::fabs(Turning(first, second).sine) <= policy.tangent_tolerance.radians();
  const auto point = is_straight ? std::nullopt : meet(first, second);
  if (!point) return normals_joined(first, second);
  const double radius = std::fmax(std::fabs(first.offset), std::fabs(second.offset));
  if (length(*point - first.end) > kFarthest * radius) return refusal(FaultKind::FlatSideChange);
  return at_point(second, *point);
}

/// The second element begins where the old radius leads, and ends with its own.
CornerEnd tapered(const Policy& policy, const Element& first, Element& second) {
  if (second.is_arc) return refusal(FaultKind::RadiusAtArc);
  const double offset = std::exchange(second.offset, first.offset);
  const CornerEnd corner =
      first.offset == 0 ? at_point(second, first.end) : contour_corner(policy, first, second);
  second.offset = offset;
  return corner;
}

CornerEnd contour_corner(const Policy& policy, const Element& first, Element& second) {
  const bool takes_next_end = policy.cutter_change == CutterChange::AtNextEnd;
  if (takes_next_end && first.offset * second.offset < 0)
    return sides_crossed(policy, first, second);
  if (takes_next_end && first.offset != second.offset) return tapered(policy, first, second);
  if (first.offset * second.offset <= 0) return normals_joined(first, second);
  const Turning turn(first, second);
  switch (shape_of(turn, second.offset, policy.tangent_tolerance.radians())) {
    case Shape::Straight:
      return first.offset == second.offset ? at_point(second, first.own_end())
                                           : normals_joined(first, second);
    case Shape::Outside:
      return outside_corner(policy, turn, first, second);
    case Shape::Inside:
      break;
  }
  return policy.inside == InsideCorner::Refuse ? refusal(FaultKind::ConcaveCorner)
                                               : intersection(first, second);
}

}  // namespace

CornerEnd round_corner(const Policy& policy, const Element& first, Element& second,
                       PlaneVector tool) {
  if (first.role == Role::StartUp) return start_up_corner(policy, first, second, tool);
  if (second.role == Role::Cancel) return cancel_corner(policy, first, second);
  return contour_corner(policy, first, second);
}

namespace {

// All below is relative to the corner, so that far-off coordinates cost no digits.

PlaneLine line_at_end(const Element& element) {
  return {element.direction_out, element.offset};
}
PlaneLine line_at_start(const Element& element) {
  return {element.direction_in, element.offset};
}
PlaneCircle circle_at_end(const Element& element) {
  return {element.arch.center - element.end, std::max(0.0, element.offset_radius_out())};
}
PlaneCircle circle_at_start(const Element& element) {
  return {element.arch.center - element.from, std::max(0.0, element.offset_radius_in())};
}

std::optional<PlaneVector> nearest(const std::optional<PointPair>& points) {
  if (!points) return std::nullopt;
  return points->nearest({});
}

std::optional<PlaneVector> meet_at_corner(const Element& first, const Element& second) {
  if (first.is_arc && second.is_arc)
    return nearest(meet(circle_at_end(first), circle_at_start(second)));
  if (first.is_arc) return nearest(meet(line_at_start(second), circle_at_end(first)));
  if (second.is_arc) return nearest(meet(line_at_end(first), circle_at_start(second)));
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
