#include "gateway/interpreter/tnc155/probing_functions.hpp"

#include <cmath>

namespace dripline::interpreter::tnc155 {
namespace {

double sign_of(const Touch& touch) {
  return touch.direction == ProbeDirection::Positive ? 1 : -1;
}

PlaneVector in_plane(const Position& position, Plane plane) {
  const PlaneAxes axes = axes_of(plane);
  return {position.raw(axes.first), position.raw(axes.second)};
}

/// The point of the wall that the ball touched, as far as one touch along an axis can tell.
PlaneVector wall_point(const Touch& touch, const Position& at, const Stylus& stylus, Plane plane) {
  PlaneVector point = in_plane(at, plane);
  double& along = touch.axis == axes_of(plane).first ? point.first : point.second;
  along += sign_of(touch) * stylus.radius;
  return point;
}

double angle_of(PlaneVector direction) {
  return std::atan2(direction.second, direction.first) * (180 / Angle::kPi);
}

/// Half the way between touches on either side, along each axis of the plane.
struct Spans {
  double first = 0, second = 0;
  PlaneVector middle;
};
Spans spans_of(std::span<const Position, 4> touches, Plane plane) {
  const PlaneAxes axes = axes_of(plane);
  const double first_up = touches[0].raw(axes.first), first_down = touches[1].raw(axes.first);
  const double second_up = touches[2].raw(axes.second), second_down = touches[3].raw(axes.second);
  return {std::fabs(first_up - first_down) / 2,
          std::fabs(second_up - second_down) / 2,
          {(first_up + first_down) / 2, (second_up + second_down) / 2}};
}

}  // namespace

Result<Position> touch(const Workpiece& workpiece, const Stylus& stylus, const Touch& touch) {
  Position to = touch.from;
  to.set_raw(touch.axis, touch.from.raw(touch.axis) + sign_of(touch) * stylus.travel);
  const ProbeResult result = workpiece.probe(touch.from, to, ProbeUntil::Contact);
  if (!result.tripped || result.at.same_point(touch.from)) {
    return fail(Errc::NotFound, "TOUCH POINT INACCESSIBLE: {}{} from {} {:g} within {:g} mm",
                letter(touch.axis), sign_of(touch) > 0 ? '+' : '-', letter(touch.axis),
                touch.from.raw(touch.axis), stylus.travel);
  }
  return result.at;
}

double touched_coordinate(const Position& at, const Touch& touch, const Stylus& stylus,
                          Axis tool_axis) {
  const double centre = at.raw(touch.axis);
  return touch.axis == tool_axis ? centre : centre + sign_of(touch) * stylus.radius;
}

double calibrated_length(const Position& at, Axis tool_axis, double plane) {
  return at.raw(tool_axis) - plane;
}

Result<double> calibrated_radius(std::span<const Position, 4> touches, Plane plane,
                                 double ring_radius) {
  const Spans spans = spans_of(touches, plane);
  const double radius = ring_radius - (spans.first + spans.second) / 2;
  if (radius >= 0) return radius;
  return fail(Errc::LimitExceeded, "the touches are wider than the ring of radius {:g}: by {:g}",
              ring_radius, -radius);
}

Result<double> basic_rotation(const Position& first, const Position& second, Plane plane,
                              double nominal) {
  const PlaneVector way = in_plane(second, plane) - in_plane(first, plane);
  if (way == PlaneVector{}) return fail(Errc::LimitExceeded, "both touches at the same point");
  // A side has no sense: its angle counts modulo half a turn.
  return std::remainder(angle_of(way) - nominal, 180.0);
}

Result<Corner> corner(const Side& first, const Side& second, const Stylus& stylus, Plane plane) {
  const auto line_of = [&](const Side& side) {
    const PlaneVector from = wall_point(side.first, side.first_at, stylus, plane);
    return std::pair(from, wall_point(side.second, side.second_at, stylus, plane) - from);
  };
  const auto [a, along_a] = line_of(first);
  const auto [b, along_b] = line_of(second);
  const double turn = cross(along_a, along_b);
  if (std::fabs(turn) < 1e-9 * length(along_a) * length(along_b) || length(along_a) == 0 ||
      length(along_b) == 0) {
    return fail(Errc::LimitExceeded, "the sides are parallel: they have no corner");
  }
  return Corner{a + (cross(b - a, along_b) / turn) * along_a, angle_of(along_a), angle_of(along_b)};
}

Circle circle_centre(std::span<const Position, 4> touches, Plane plane, bool is_bore,
                     const Stylus& stylus) {
  const Spans spans = spans_of(touches, plane);
  const double half = (spans.first + spans.second) / 2;
  return {spans.middle, is_bore ? half + stylus.radius : half - stylus.radius};
}

}  // namespace dripline::interpreter::tnc155
