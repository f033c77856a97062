#include "clients/tools/tnc_probing/probing_functions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace dripline::tnc_probing {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

double sign_of(const Touch& touch) {
  return touch.direction == ProbeDirection::Positive ? 1 : -1;
}

PlaneVector in_plane(const Position& position, Plane plane) {
  const PlaneAxes axes = axes_of(plane);
  return {position.raw(axes.first), position.raw(axes.second)};
}

double angle_of(PlaneVector direction) {
  return std::atan2(direction.second, direction.first) * (180 / Angle::kPi);
}

/// Half the distance between the contacts on both sides, along each axis of the plane.
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

std::string name_of(const Touch& touch) {
  return {letter(touch.axis), sign_of(touch) > 0 ? '+' : '-'};
}
bool is_same_direction(const Touch& a, const Touch& b) {
  return a.axis == b.axis && a.direction == b.direction;
}
/// X, Y or Z that an axis is parallel to or rotates about.
Axis main_axis(Axis axis) {
  return static_cast<Axis>(static_cast<std::size_t>(axis) % 3);
}
double distance_from_axis(const Position& at, Axis rotary) {
  const PlaneAxes axes = axes_of(plane_across(main_axis(rotary)));
  return std::hypot(at.raw(axes.first), at.raw(axes.second));
}

Error inaccessible(const Touch& touch, double travel) {
  return {Errc::NotFound,
          fmt::format("TOUCH POINT INACCESSIBLE: {} from {} {:g} within {:g} {}", name_of(touch),
                      letter(touch.axis), touch.from.raw(touch.axis), travel,
                      is_rotary(touch.axis) ? "degrees" : "mm")};
}

Result<Position> touch_parallel(const Workpiece& workpiece, const Stylus& stylus,
                                const Touch& touch) {
  const Axis main = main_axis(touch.axis);
  const double away = touch.from.raw(main);
  Position from = touch.from;
  from.set_raw(main, away + touch.from.raw(touch.axis));
  Position to = from;
  to.set_raw(main, from.raw(main) + sign_of(touch) * stylus.travel);
  const ProbeResult result = workpiece.probe(from, to, ProbeUntil::Contact);
  if (!result.tripped || result.at.same_point(from)) {
    return tl::make_unexpected(inaccessible(touch, stylus.travel));
  }
  Position at = touch.from;
  at.set_raw(touch.axis, result.at.raw(main) - away);
  return at;
}

/// The stylus goes round in chords, which leave its circle by less than a thousandth of a
/// micrometer in ten millimeters.
Result<Position> touch_around(const Workpiece& workpiece, const Stylus& stylus,
                              const Touch& touch) {
  constexpr double kStep = 0.05;  // degrees
  const PlaneAxes axes = axes_of(plane_across(main_axis(touch.axis)));
  const double radius = distance_from_axis(touch.from, touch.axis);
  if (radius <= stylus.radius) {
    return fail(Errc::LimitExceeded, "the ball is on the rotary axis {}, {:g} from it",
                letter(touch.axis), radius);
  }
  const double begin = std::atan2(touch.from.raw(axes.second), touch.from.raw(axes.first)) +
                       touch.from.raw(touch.axis) * (Angle::kPi / 180);
  const auto place = [&](double degrees) {
    const double angle = begin + sign_of(touch) * degrees * (Angle::kPi / 180);
    Position at = touch.from;
    at.set_raw(axes.first, radius * std::cos(angle));
    at.set_raw(axes.second, radius * std::sin(angle));
    return at;
  };
  for (double travel = 0; travel < stylus.travel; travel += kStep) {
    const double step = std::min(kStep, stylus.travel - travel);
    const Position from = place(travel), to = place(travel + step);
    const ProbeResult result = workpiece.probe(from, to, ProbeUntil::Contact);
    if (!result.tripped) continue;
    if (travel == 0 && result.at.same_point(from)) break;
    const auto along = [&](const Position& a) {
      return std::hypot(a.raw(axes.first) - from.raw(axes.first),
                        a.raw(axes.second) - from.raw(axes.second));
    };
    Position at = touch.from;
    const double turned = travel + step * along(result.at) / along(to);
    at.set_raw(touch.axis, touch.from.raw(touch.axis) + sign_of(touch) * turned);
    return at;
  }
  return tl::make_unexpected(inaccessible(touch, stylus.travel));
}

Result<void> wrong_touch(std::size_t i, const Touch& touch, std::string_view expected) {
  return fail(Errc::Syntax, "touch {} is {}: {}", i + 1, name_of(touch), expected);
}

/// All along axes of the plane across the tool.
Result<void> check_in_plane(std::span<const Touch> touches, Axis tool_axis) {
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (touches[i].axis <= Axis::Z && touches[i].axis != tool_axis) continue;
    return wrong_touch(
        i, touches[i],
        fmt::format("expected an axis across the tool, which is {}", letter(tool_axis)));
  }
  return {};
}

Result<void> check_four_directions(std::span<const Touch> touches, Axis tool_axis) {
  const PlaneAxes axes = axes_of(plane_across(tool_axis));
  const char first = letter(axes.first), second = letter(axes.second);
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const Touch expected{{},
                         i < 2 ? axes.first : axes.second,
                         i % 2 == 0 ? ProbeDirection::Positive : ProbeDirection::Negative};
    if (is_same_direction(touches[i], expected)) continue;
    return wrong_touch(
        i, touches[i],
        fmt::format("expected {}+, {}-, {}+ and {}-, in this order", first, first, second, second));
  }
  return {};
}

/// Two touches of one direction from `i` on.
Result<void> check_side(std::span<const Touch> touches, std::size_t i) {
  if (is_same_direction(touches[i], touches[i + 1])) return {};
  return wrong_touch(
      i + 1, touches[i + 1],
      fmt::format("expected {}, as the other touch of this side", name_of(touches[i])));
}

}  // namespace

std::size_t touches_of(ProbingFunction function) {
  switch (function) {
    case ProbingFunction::Length:
    case ProbingFunction::Surface:
      return 1;
    case ProbingFunction::Rotation:
      return 2;
    default:
      return 4;
  }
}

Result<void> check_touches(ProbingFunction function, std::span<const Touch> touches,
                           Axis tool_axis) {
  if (touches.size() != touches_of(function)) {
    return fail(Errc::Syntax, "{} touches are needed, {} are there", touches_of(function),
                touches.size());
  }
  switch (function) {
    case ProbingFunction::Surface:
      return {};
    case ProbingFunction::Length:
      if (touches[0].axis == tool_axis) return {};
      return wrong_touch(0, touches[0],
                         fmt::format("expected the tool's axis, {}", letter(tool_axis)));
    case ProbingFunction::Radius:
    case ProbingFunction::Circle:
      return check_four_directions(touches, tool_axis);
    default:
      break;
  }
  if (auto checked = check_in_plane(touches, tool_axis); !checked) return checked;
  if (auto checked = check_side(touches, 0); !checked) return checked;
  if (function == ProbingFunction::Rotation) return {};
  if (auto checked = check_side(touches, 2); !checked) return checked;
  if (touches[0].axis != touches[2].axis) return {};
  return wrong_touch(2, touches[2],
                     fmt::format("expected the other axis for the second side, the first has {}",
                                 name_of(touches[0])));
}

Result<Position> touch(const Workpiece& workpiece, const Stylus& stylus, const Touch& touch) {
  if (is_rotary(touch.axis)) return touch_around(workpiece, stylus, touch);
  if (touch.axis > Axis::Z) return touch_parallel(workpiece, stylus, touch);
  Position to = touch.from;
  to.set_raw(touch.axis, touch.from.raw(touch.axis) + sign_of(touch) * stylus.travel);
  const ProbeResult result = workpiece.probe(touch.from, to, ProbeUntil::Contact);
  if (!result.tripped || result.at.same_point(touch.from)) {
    return tl::make_unexpected(inaccessible(touch, stylus.travel));
  }
  return result.at;
}

double touched_coordinate(const Position& at, const Touch& touch, const Stylus& stylus,
                          Axis tool_axis) {
  const double center = at.raw(touch.axis);
  if (is_rotary(touch.axis)) {
    const double half = std::asin(stylus.radius / distance_from_axis(at, touch.axis));
    return center + sign_of(touch) * half * (180 / Angle::kPi);
  }
  const bool is_tip = main_axis(touch.axis) == tool_axis;
  return is_tip ? center : center + sign_of(touch) * stylus.radius;
}

Position touched_point(const Position& at, const Touch& touch, const Stylus& stylus, Axis tool_axis,
                       const Transformation& frame) {
  Position point = at;
  if (touch.axis > Axis::Z) {
    point.set_raw(touch.axis, touched_coordinate(at, touch, stylus, tool_axis));
    return point;
  }
  Transformation turn;
  turn.basic_rotation = frame.basic_rotation;
  turn.basic_plane = frame.basic_plane;
  Transformation::Values offset{};
  offset[static_cast<std::size_t>(touch.axis)] =
      touched_coordinate(at, touch, stylus, tool_axis) - at.raw(touch.axis);
  offset = turn.to_machine(offset);
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    point.set_raw(axis, at.raw(axis) + offset[static_cast<std::size_t>(axis)]);
  }
  return point;
}

Transformation::Values datum_for(const Transformation& frame, const Position& point,
                                 std::span<const NamedCoordinate> named) {
  Transformation turn;
  turn.datum = frame.datum;
  turn.basic_rotation = frame.basic_rotation;
  turn.basic_plane = frame.basic_plane;
  Transformation::Values at{};
  for (const Axis axis : kAllAxes) at[static_cast<std::size_t>(axis)] = point.raw(axis);
  Transformation::Values program = turn.to_program(at);
  for (const NamedCoordinate& one : named) program[static_cast<std::size_t>(one.axis)] = one.value;
  turn.datum = {};
  const Transformation::Values from_datum = turn.to_machine(program);
  for (std::size_t i = 0; i < kAxisCount; ++i) at[i] -= from_datum[i];
  return at;
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
  const PlaneVector along = in_plane(second, plane) - in_plane(first, plane);
  if (along == PlaneVector{}) return fail(Errc::LimitExceeded, "both touches at the same point");
  // A side has no sense: its angle is defined modulo 180 degrees.
  return std::remainder(angle_of(along) - nominal, 180.0);
}

Result<Corner> corner(const Side& first, const Side& second, const Stylus& stylus, Plane plane) {
  const auto line_of = [&](const Side& side) {
    const PlaneVector from = in_plane(side.first_at, plane);
    const PlaneVector along = in_plane(side.second_at, plane) - from;
    const double distance = length(along);
    if (distance == 0) return std::pair(from, along);
    // Across the wall, to the side where the touches lead.
    const bool is_first = side.first.axis == axes_of(plane).first;
    const double lead = (is_first ? -along.second : along.first) * sign_of(side.first);
    const double ball = (lead < 0 ? -stylus.radius : stylus.radius) / distance;
    return std::pair(from + ball * PlaneVector{-along.second, along.first}, along);
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

Circle circle_center(std::span<const Position, 4> touches, Plane plane, bool is_bore,
                     const Stylus& stylus) {
  const Spans spans = spans_of(touches, plane);
  const double half = (spans.first + spans.second) / 2;
  return {spans.middle, is_bore ? half + stylus.radius : half - stylus.radius};
}

}  // namespace dripline::tnc_probing
