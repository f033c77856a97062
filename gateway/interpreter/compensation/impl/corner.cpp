#include "gateway/interpreter/compensation/impl/corner.hpp"

#include <cmath>

#include "gateway/interpreter/compensation/impl/intersection.hpp"

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

/// Where the path turns back on itself, elements that bend away from the tool leave a valley; round
/// any others the tool has to go.
Shape shape_of(const Turning& turn, double offset, double tolerance) {
  if (std::fabs(turn.sine) <= tolerance) {
    if (turn.cosine > 0) return Shape::Straight;
    return turn.bend * offset < 0 ? Shape::Inside : Shape::Outside;
  }
  return (turn.sine < 0) == (offset > 0) ? Shape::Outside : Shape::Inside;
}

Corner at_point(PlaneVector point) {
  return {.end = point, .begin = point, .between = {}, .fault = {}};
}
Corner refusal(FaultKind kind) {
  return {.end = {}, .begin = {}, .between = {}, .fault = kind};
}
void go_straight(Corner& corner, PlaneVector to) {
  const PlaneVector from =
      corner.between.count ? corner.between.pieces[corner.between.count - 1].to : corner.end;
  if (length(to - from) > kNoLength) corner.between.add({.is_arc = false, .to = to, .center = {}});
}

/// Each on its own normal, with a straight piece between.
Corner normals_joined(const Element& first, const Element& second) {
  Corner corner = at_point(first.own_end());
  corner.begin = second.own_begin();
  go_straight(corner, corner.begin);
  return corner;
}

Corner intersection(const Element& first, const Element& second) {
  const auto point = meet(first, second);
  return point ? at_point(*point) : refusal(FaultKind::NoIntersection);
}

Corner extended(const Policy& policy, const Element& first, const Element& second) {
  const Turning turn(first, second);
  const bool is_sharp = turn.cosine < std::cos(policy.sharpest.radians()) - kSharpness;
  const bool is_parallel = std::fabs(turn.sine) < kSharpness;
  PlaneVector leaving, arriving;
  if (is_sharp || is_parallel) {
    leaving = first.own_end() + std::fabs(first.offset) * first.direction_out;
    arriving = second.own_begin() - std::fabs(second.offset) * second.direction_in;
  } else {
    leaving = arriving = tangents_meet(first, second);
  }
  Corner corner = at_point(first.is_arc ? first.own_end() : leaving);
  go_straight(corner, leaving);
  go_straight(corner, arriving);
  corner.begin = second.is_arc ? second.own_begin() : arriving;
  go_straight(corner, corner.begin);
  return corner;
}

/// Round `first.end` from the point `from` on the cutter's circle to the second's own normal.
void go_round(Corner& corner, PlaneVector from, const Element& first, const Element& second) {
  const PlaneVector at = first.end;
  PlaneVector arrival = at + std::copysign(length(from - at), second.offset) * second.normal_in();
  double sweep = turn_between(from - at, arrival - at);
  if (std::fabs(sweep * second.offset) <= kNoLength) return go_straight(corner, arrival);
  // away from the compensated side, whatever rounding makes of a half circle
  if ((sweep > 0) == (second.offset > 0)) sweep = -sweep;
  corner.between.add({.is_arc = true, .to = arrival, .center = at, .sweep = sweep});
}

Corner rounded(const Element& first, const Element& second) {
  Corner corner = at_point(first.own_end());
  go_round(corner, corner.end, first, second);
  corner.begin = second.own_begin();
  go_straight(corner, corner.begin);
  return corner;
}

Corner outside_corner(const Policy& policy, const Element& first, const Element& second) {
  if (first.offset == 0) return at_point(first.end);
  switch (first.outside) {
    case OutsideCorner::IntersectCurves:
      return intersection(first, second);
    case OutsideCorner::Arc:
      if (!second.is_rapid) return rounded(first, second);
      break;
    case OutsideCorner::ExtendTangents:
      break;
  }
  return extended(policy, first, second);
}

/// The start-up line from `tool` touches the cutter's circle about its end, which the tool then
/// follows to the next element's normal.
Corner touched(const Element& first, const Element& second, PlaneVector tool) {
  const PlaneVector back = tool - first.end;
  const double distance = length(back);
  const double radius = std::fabs(first.offset);
  if (distance <= radius) return refusal(FaultKind::StartUpTooClose);
  const PlaneVector out = (1 / distance) * back;
  const double cosine = radius / distance;
  const double sine = std::sqrt(1 - cosine * cosine) * (first.offset > 0 ? -1 : 1);
  Corner corner = at_point(first.end + radius * (cosine * out + sine * left_of(out)));
  go_round(corner, corner.end, first, second);
  corner.begin = second.own_begin();
  return corner;
}

/// Of the line that `touched` takes, not of the programmed one.
Element touching_line(const Element& first, PlaneVector tool, PlaneVector end) {
  Element line = first;
  const PlaneVector along = end - tool;
  line.direction_out = (1 / length(along)) * along;
  return line;
}

Corner tangential_start(const Policy& policy, const Element& first, const Element& second,
                        PlaneVector tool) {
  if (first.offset == 0 || second.is_rapid) return at_point(second.own_begin());
  Corner corner = touched(first, second, tool);
  if (corner.fault) return corner;
  const Element line = touching_line(first, tool, corner.end);
  const double tolerance = policy.tangent_tolerance.radians();
  switch (shape_of(Turning(line, second), second.offset, tolerance)) {
    case Shape::Outside:
      return corner;
    case Shape::Straight:
      return at_point(second.own_begin());
    case Shape::Inside:
      break;
  }
  return policy.inside == InsideCorner::Refuse ? refusal(FaultKind::ConcaveCorner)
                                               : at_point(second.own_begin());
}

Corner start_up_corner(const Policy& policy, const Element& first, const Element& second,
                       PlaneVector tool) {
  if (second.role == Role::Cancel) return at_point(first.own_end());
  if (first.start_up == StartUp::Tangent) return tangential_start(policy, first, second, tool);
  const Shape shape =
      shape_of(Turning(first, second), second.offset, policy.tangent_tolerance.radians());
  if (first.start_up == StartUp::Corner && shape == Shape::Outside)
    return outside_corner(policy, first, second);
  return at_point(second.own_begin());
}

/// The cancel move counts as offset like the element before it, but ends where programmed.
Corner cancel_corner(const Policy& policy, const Element& first, const Element& second) {
  const Shape shape =
      shape_of(Turning(first, second), second.offset, policy.tangent_tolerance.radians());
  if (policy.cancel == Cancel::Corner && shape == Shape::Outside && first.role != Role::StartUp)
    return outside_corner(policy, first, second);
  return at_point(first.own_end());
}

Corner contour_corner(const Policy& policy, const Element& first, const Element& second) {
  if (first.offset * second.offset <= 0) return normals_joined(first, second);
  switch (shape_of(Turning(first, second), second.offset, policy.tangent_tolerance.radians())) {
    case Shape::Straight:
      return first.offset == second.offset ? at_point(first.own_end())
                                           : normals_joined(first, second);
    case Shape::Outside:
      return outside_corner(policy, first, second);
    case Shape::Inside:
      break;
  }
  return policy.inside == InsideCorner::Refuse ? refusal(FaultKind::ConcaveCorner)
                                               : intersection(first, second);
}

}  // namespace

Corner round_corner(const Policy& policy, const Element& first, const Element& second,
                    PlaneVector tool) {
  if (first.role == Role::StartUp) return start_up_corner(policy, first, second, tool);
  if (second.role == Role::Cancel) return cancel_corner(policy, first, second);
  return contour_corner(policy, first, second);
}

}  // namespace dripline::interpreter::compensation::impl
