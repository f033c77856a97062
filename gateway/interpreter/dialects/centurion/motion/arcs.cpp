#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"
#include "gateway/interpreter/dialects/centurion/motion/probe_moves.hpp"

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

namespace {

constexpr AddressSet kAbsoluteCenter = set_of(Address::XC, Address::ZC);

/// What is known of an arc before its end point is read.
struct ArcCenter {
  Point center;
  double radius = 0;
  bool is_known = false;  ///< to Trig Help: the blending stage computes the ends
};

bool check_on_arc(Run& run, const ArcCenter& arc, const Point& point) {
  if (arc.is_known) return true;
  const double off_by = std::fabs(distance(point, arc.center) - arc.radius);
  if (off_by <= arc_tolerance(run)) return true;
  const bool misses_radius =
      !run.state.retained.has_radius && run.block.words.has_any(kAbsoluteCenter);
  return run.fail(ErrorCode::OutOfPosition, motion_column(run),
                  fmt::format("point is {:.6f} off the radius {:.6f}{}", off_by, arc.radius,
                              misses_radius ? " of the start point: no R is known" : ""));
}

bool refuse_negative_radius(Run& run) {
  return run.fail(ErrorCode::NegativeArcRadius, run.block.words.column(Address::R));
}

/// XC, ZC: a missing one is that of the start point.
bool read_absolute_center(Run& run, ArcCenter& arc) {
  const Words& words = run.block.words;
  const ModalState& state = run.state;
  arc.is_known = state.retained.has_radius && has_trig_help(run);
  arc.center = state.position;
  if (words.has(Address::XC)) arc.center.x = state.origin.x + words[Address::XC] / 2;
  if (words.has(Address::ZC)) arc.center.z = state.origin.z + words[Address::ZC];
  if (words.has(Address::R) && words[Address::R] < 0) return refuse_negative_radius(run);
  arc.radius = state.retained.has_radius ? std::fabs(state.retained.radius)
                                         : distance(state.position, arc.center);
  return check_on_arc(run, arc, state.position);
}

bool read_start_angle_center(Run& run, ArcCenter& arc) {
  const Words& words = run.block.words;
  const ModalState& state = run.state;
  if (words.has(Address::R) && words[Address::R] < 0) return refuse_negative_radius(run);
  if (!state.retained.has_radius) {
    return run.fail(ErrorCode::IllegalStatement, words.column(Address::AA), "AA needs R");
  }
  arc.radius = std::fabs(state.retained.radius);
  arc.center = polar(state.position, -arc.radius, words[Address::AA]);
  return true;
}

void read_relative_center(Run& run, ArcCenter& arc) {
  const Words& words = run.block.words;
  RetainedWords& retained = run.state.retained;
  if (words.has_any(set_of(Address::I, Address::K))) {
    retained.center_x = words.has(Address::I) ? words[Address::I] : 0;
    retained.center_z = words.has(Address::K) ? words[Address::K] : 0;
    retained.arc_has_radius = false;
  }
  arc.center = {run.state.position.x + retained.center_x, run.state.position.z + retained.center_z};
  arc.radius = std::hypot(retained.center_x, retained.center_z);
}

bool emit_arc(Run& run, const ArcCenter& arc, const Target& target) {
  if (arc.radius <= 0) {
    return run.fail(ErrorCode::RadiusTooSmall, motion_column(run), "the arc has no radius");
  }
  const bool is_thread = run.block.parts.thread_code != 0;
  if (!is_thread && !check_feed(run)) return false;
  ModalState& state = run.state;
  const bool is_clockwise = state.modes.motion == MotionMode::Clockwise;
  Arc event;
  event.origin = run.origin;
  event.plane = Plane::ZX;
  event.turn = is_clockwise ? Turn::Clockwise : Turn::Counterclockwise;
  event.center_first = run.length(arc.center.z);
  event.center_second = run.length(arc.center.x);
  event.sweep = Angle::degrees(sweep_of({state.position, target.to, arc.center, is_clockwise}));
  if (is_thread) {
    return thread_to(
        run, target,
        PathArc{event.center_first, event.center_second, event.plane, event.turn, event.sweep});
  }
  event.feed = run.active_feed();
  event.rests = run.rests();
  event.to = event_position(run, target.to, kBothAxes);
  state.moved_axes = 3;
  state.last_arc_center = arc.center;
  state.last_arc_radius = arc.radius;
  if (run.block.parts.probe) return probe_arc(run, event);
  announce_arc(run, arc.is_known ? std::optional(arc.radius) : std::nullopt);
  run.events().on_arc(event);
  arrive(run, target.to, kBothAxes);
  return true;
}

/// R alone, of this block or an arc before: the center follows from start and end (manual: arcs,
/// retained words).
bool move_on_radius_arc(Run& run) {
  const Words& words = run.block.words;
  if (words.has(Address::AB)) {
    return run.fail(ErrorCode::IllegalStatement, words.column(Address::AB),
                    "AB needs the arc's center");
  }
  if (!words.has_any(kEndWords)) return true;  // an arc of zero degrees
  Target target;
  if (!read_target(run, target)) return false;
  const Point start = run.state.position;
  if (distance(start, target.to) < 1e-9) {
    return run.fail(ErrorCode::CoincidentPoints, motion_column(run));
  }
  const double radius = run.state.retained.radius;
  const bool is_clockwise = run.state.modes.motion == MotionMode::Clockwise;
  const auto center = center_of({start, target.to, radius, is_clockwise}, arc_tolerance(run));
  if (!center) {
    const auto column = words.has(Address::R) ? words.column(Address::R) : motion_column(run);
    return run.fail(ErrorCode::RadiusTooSmall, column,
                    fmt::format("R{} for points {:.6f} apart", radius, distance(start, target.to)));
  }
  return emit_arc(run, {*center, std::fabs(radius), false}, target);
}

bool read_arc_end(Run& run, const ArcCenter& arc, Target& target) {
  const Words& words = run.block.words;
  if (!words.has(Address::AB)) {
    return read_target(run, target) && check_on_arc(run, arc, target.to);
  }
  if (words.has_any(kEndWords)) {
    return run.fail(ErrorCode::IllegalStatement, words.column(Address::AB),
                    "an arc ends at X and Z or at AB, not both");
  }
  run.state.retained.end_angle = words[Address::AB];
  target.to = polar(arc.center, arc.radius, words[Address::AB]);
  return check_target(run, target.to);
}

/// A block with neither R nor a center uses that of the last arc.
bool uses_radius_before(const Run& run) {
  return run.state.retained.arc_has_radius &&
         !run.block.words.has_any(set_of(Address::I, Address::K));
}

bool refuse_missing_center(Run& run) {
  return run.fail(
      ErrorCode::RadiusTooSmall, motion_column(run),
      "the arc has neither R nor a center (I K, XC ZC, AA), and no arc before it had one");
}

}  // namespace

bool move_on_arc(Run& run) {
  const Words& words = run.block.words;
  RetainedWords& retained = run.state.retained;
  if (run.block.parts.axis_row != kNoRow) {
    return run.fail(ErrorCode::IllegalStatement, motion_column(run),
                    fmt::format("G{} moves on straight lines", run.axis_code()));
  }
  const bool has_radius = words.has(Address::R);
  if (has_radius) {
    retained.radius = words[Address::R];
    retained.has_radius = retained.arc_has_radius = true;
  }
  if (words.has(Address::AA)) retained.start_angle = words[Address::AA];
  ArcCenter arc;
  if (words.has_any(kAbsoluteCenter)) {
    if (!read_absolute_center(run, arc)) return false;
  } else if (words.has(Address::AA)) {
    if (!read_start_angle_center(run, arc)) return false;
  } else if (has_radius || uses_radius_before(run)) {
    return move_on_radius_arc(run);  // R has priority over I and K
  } else {
    read_relative_center(run, arc);
    if (arc.radius <= 0) return refuse_missing_center(run);
  }
  if (!check_on_arc(run, arc, run.state.position)) return false;
  Target target;
  return read_arc_end(run, arc, target) && emit_arc(run, arc, target);
}

}  // namespace dripline::interpreter::centurion
