#include "gateway/interpreter/dialects/tektronix1704/motion.hpp"

#include <fmt/format.h>
#include <bit>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

constexpr double kLargestRadius = 999'999;
constexpr double kAngleNoise = 1e-6;  ///< degrees

Address end_address(std::size_t axis) {
  return static_cast<Address>(static_cast<std::size_t>(Address::X) + axis);
}
Address center_address(std::size_t axis) {
  return static_cast<Address>(static_cast<std::size_t>(Address::I) + axis);
}

Plane plane_of(bool x, bool y, bool z) {
  if (x && y) return Plane::XY;
  return z && x ? Plane::ZX : Plane::YZ;
}

/// The two end letters name the plane; with one, two center words do, else it stays (manual:
/// plane of an arc).
bool choose_plane(Run& run) {
  const Words& words = run.state.block.words;
  const int ends = std::popcount(static_cast<unsigned>(words.present() & kEndWords));
  if (ends == 3) return run.fail(Fault::ThreeAxes);
  if (ends == 2) {
    run.state.plane = plane_of(words.has(Address::X), words.has(Address::Y), words.has(Address::Z));
    return true;
  }
  const int centers = std::popcount(static_cast<unsigned>(words.present() & kCenterWords));
  if (centers == 2) {
    run.state.plane = plane_of(words.has(Address::I), words.has(Address::J), words.has(Address::K));
  }
  return true;
}

struct PlanePoint {
  double first = 0, second = 0;
  double radius() const { return std::hypot(first, second); }
  double angle() const { return Angle::radians(std::atan2(second, first)).degrees(); }
};

/// An arc in its plane, seen from its center, in program counts.
struct PlaneArc {
  std::size_t first = 0, second = 0;  ///< axes
  Counts end{};
  PlanePoint from, to;
  bool is_counterclockwise = false;
  double sweep = 0;  ///< degrees
};

/// An axis that is not named is not kept: its store was cleared (manual: stored coordinates).
Counts arc_end(Run& run, const PlaneArc& arc) {
  Counts end = run.state.program;
  const Words& words = run.state.block.words;
  for (const std::size_t axis : {arc.first, arc.second}) {
    const bool is_named = words.has(end_address(axis));
    if (!is_named) {
      run.warn(Fault::MissingEnd, run.origin, 0, std::string(1, letter(static_cast<Axis>(axis))));
    }
    const std::int64_t value = is_named ? words[end_address(axis)] : 0;
    end[axis] = run.state.is_incremental ? end[axis] + value : value;
  }
  return end;
}

bool is_in_one_quadrant(const PlaneArc& arc, double tolerance) {
  const auto same_side = [tolerance](double a, double b) {
    return std::fabs(a) <= tolerance || std::fabs(b) <= tolerance || (a > 0) == (b > 0);
  };
  return arc.sweep <= 90 + kAngleNoise + 0.5 && same_side(arc.from.first, arc.to.first) &&
         same_side(arc.from.second, arc.to.second);
}

/// Where the manual leaves open what happens, only `arc_policy = "run"` continues.
bool object_to_arc(Run& run, const DiagnosticRow& fault, std::string_view detail) {
  if (!run.options.runs_bad_arcs) return run.fail(fault, 0, detail);
  run.warn(fault, run.origin, 0, detail);
  return true;
}

bool check_arc(Run& run, const PlaneArc& arc, bool& is_bad) {
  const double from = arc.from.radius();
  const double to = arc.to.radius();
  if (from < 1 || from > kLargestRadius) {
    return run.fail(Fault::Radius, 0, fmt::format("{:.1f} counts", from));
  }
  const auto tolerance = static_cast<double>(run.options.arc_tolerance);
  if (std::fabs(to - from) > tolerance) {
    is_bad = true;
    if (!object_to_arc(run, Fault::OffTheCircle,
                       fmt::format("radius {:.1f} at the start, {:.1f} at the end", from, to))) {
      return false;
    }
  }
  if (!is_in_one_quadrant(arc, tolerance)) {
    return object_to_arc(run, Fault::Quadrant, fmt::format("{:.1f} degrees", arc.sweep));
  }
  return true;
}

/// G94 leaves the stored center as it is: counted from the new zero it is another place.
void warn_of_old_center(Run& run, const PlaneArc& arc) {
  std::string words;
  for (const std::size_t axis : {arc.first, arc.second}) {
    if (!run.state.is_center_old[axis]) continue;
    run.state.is_center_old[axis] = false;
    words += fmt::format("{}{}{}", words.empty() ? "" : " ",
                         kLetters[static_cast<std::size_t>(center_address(axis))],
                         run.state.center[axis]);
  }
  if (!words.empty()) run.warn(Fault::CenterBeforePreset, run.origin, 0, words);
}

double sweep_of(const PlaneArc& arc) {
  double sweep = arc.to.angle() - arc.from.angle();
  if (!arc.is_counterclockwise) sweep = -sweep;
  return sweep <= 0 ? sweep + 360 : sweep;
}

Direction tangent(const PlaneArc& arc, const PlanePoint& at) {
  const double sign = arc.is_counterclockwise ? 1 : -1;
  Direction direction{};
  direction[arc.first] = -sign * at.second;
  direction[arc.second] = sign * at.first;
  return direction;
}

void emit_arc(Run& run, const PlaneArc& arc, double feed) {
  State& state = run.state;
  Arc event;
  event.origin = run.origin;
  event.plane = state.plane;
  const bool is_turned = run.options.mirror[arc.first] != run.options.mirror[arc.second];
  event.turn = arc.is_counterclockwise != is_turned ? Turn::Counterclockwise : Turn::Clockwise;
  event.sweep = Angle::degrees(arc.sweep);
  event.feed = Feed::per_minute(Length::mm(feed));
  event.rests = !flows_on(state.motion);
  const auto center_of = [&](std::size_t axis) {
    return Length::mm(run.machine_mm(axis, static_cast<double>(state.center[axis])));
  };
  event.center_first = center_of(arc.first);
  event.center_second = center_of(arc.second);
  for (const std::size_t axis : {arc.first, arc.second}) {
    run.position.set(static_cast<Axis>(axis),
                     Length::mm(run.machine_mm(axis, static_cast<double>(arc.end[axis]))));
  }
  state.program = arc.end;
  event.to = run.position;
  run.events().on_arc(event);
}

/// Swept at its own radius to the ray of the end point; the rest is a line.
bool sweep_to_ray(Run& run, PlaneArc arc, double feed) {
  const Counts end = arc.end;
  const double scale = arc.from.radius() / arc.to.radius();
  const Counts& center = run.state.center;
  arc.end[arc.first] = center[arc.first] + std::llround(arc.to.first * scale);
  arc.end[arc.second] = center[arc.second] + std::llround(arc.to.second * scale);
  emit_arc(run, arc, feed);
  return move_line(run, {end, Pace::Feed, flows_on(run.state.motion)});
}

}  // namespace

void load_center(Run& run) {
  const Words& words = run.state.block.words;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const Address address = center_address(axis);
    if (!words.has(address)) continue;
    run.state.center[axis] =
        (run.state.is_incremental ? run.state.program[axis] : 0) + words[address];
    run.state.is_center_old[axis] = false;
    run.ledger.take(bit(address));
  }
}

bool move_arc(Run& run) {
  State& state = run.state;
  if (!choose_plane(run)) return false;
  const PlaneAxes axes = axes_of(state.plane);
  PlaneArc arc;
  arc.first = static_cast<std::size_t>(axes.first);
  arc.second = static_cast<std::size_t>(axes.second);
  arc.is_counterclockwise = state.motion == Motion::G03 || state.motion == Motion::G30;
  warn_of_old_center(run, arc);
  arc.end = arc_end(run, arc);
  if (arc.end == state.program) {
    run.warn(Fault::NoArc, run.origin);
    return true;
  }
  const auto seen_from_center = [&](const Counts& point) {
    return PlanePoint{static_cast<double>(point[arc.first] - state.center[arc.first]),
                      static_cast<double>(point[arc.second] - state.center[arc.second])};
  };
  arc.from = seen_from_center(state.program);
  arc.to = seen_from_center(arc.end);
  arc.sweep = sweep_of(arc);
  bool is_off_circle = false;
  if (!check_arc(run, arc, is_off_circle) || !check_point(run, arc.end)) return false;
  const auto feed = feed_rate(run);
  if (!feed) return false;
  const double length = arc.from.radius() * Angle::degrees(arc.sweep).radians();
  check_turn(run,
             {tangent(arc, arc.from), tangent(arc, arc.to), length, *feed, flows_on(state.motion)});
  if (is_off_circle && arc.to.radius() >= 1) return sweep_to_ray(run, arc, *feed);
  emit_arc(run, arc, *feed);
  return true;
}

}  // namespace dripline::interpreter::tektronix1704
