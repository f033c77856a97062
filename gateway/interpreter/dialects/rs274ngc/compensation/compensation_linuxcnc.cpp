#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/offset_curves.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"

/// The later program holds the last move back until it knows the next: inside corners are trimmed
/// to where the offset curves meet. The geometry of corners is done in machine coordinates,
/// those of the held event.
namespace dripline::interpreter::rs274ngc {
namespace {

/// Between program and machine in the plane alone: each corner needs several points.
class PlaneFrame {
 public:
  explicit PlaneFrame(const Run& run) : run_(run), plane_(axes_of(run.state.modes.plane)) {}

  PlaneVector machine_point(PlaneVector program) const {
    const State& state = run_.state;
    if (state.rotation == 0) [[likely]] {
      const auto shifted = [&](Axis axis, double value) {
        return value + state.g92[index_of(axis)] + state.system_offset[index_of(axis)];
      };
      return {shifted(plane_.first, program.first), shifted(plane_.second, program.second)};
    }
    Axes axes = state.position;
    axes[index_of(plane_.first)] = program.first;
    axes[index_of(plane_.second)] = program.second;
    return in_plane(to_machine(run_, axes), plane_);
  }
  PlaneVector machine_direction(PlaneVector program) const {
    if (run_.state.rotation == 0) [[likely]]
      return program;
    const double turned = run_.state.rotation * (Angle::kPi / 180);
    return std::cos(turned) * program + std::sin(turned) * left_of(program);
  }

 private:
  const Run& run_;
  PlaneAxes plane_;
};

PlaneVector plane_point(const Run& run, const Position& position) {
  return in_plane(position, axes_of(run.state.modes.plane));
}

void put(const Run& run, Position& position, PlaneVector point) {
  set_in_plane(position, axes_of(run.state.modes.plane), point);
}

PlaneVector center_of(const Arc& arc) {
  return {arc.center_first.mm(), arc.center_second.mm()};
}

/// The held move's curve: an arc's circle, or the line it was programmed along.
OffsetCurve held_curve(const Run& run, PlaneVector tool, PlaneVector old_normal) {
  if (const auto* arc = std::get_if<Arc>(&run.held.events().front())) {
    const PlaneVector center = center_of(*arc);
    return {.is_circle = true, .at = center, .along = {}, .radius = length(tool - center)};
  }
  return {.at = tool, .along = left_of(old_normal)};
}

/// Ends the held arc at `end`; false when it would then be longer than it was programmed, for its
/// corners have eaten it up.
bool end_arc(const Run& run, Arc& arc, PlaneVector end) {
  const double slack = run.state.units == Units::Inch ? 0.001 : 0.0254;  // radians
  const double whole = 360 * std::floor((arc.sweep.degrees() - 1e-6) / 360);
  const bool is_whole = end == plane_point(run, arc.to);
  const double sweep =
      is_whole ? arc.sweep.degrees() - whole
               : sweep_of(center_of(arc), plane_point(run, run.held.start()), end, arc.turn);
  if (sweep > run.state.compensation.held_sweep + slack * (180 / Angle::kPi)) return false;
  put(run, arc.to, end);
  arc.sweep = Angle::degrees(sweep + whole);
  return true;
}

bool is_reversed(const Run& run, PlaneVector end, PlaneVector travel) {
  return dot(end - plane_point(run, run.held.start()), travel) < 0;
}

/// A corner may only shorten the move before it. Where the path doubles straight back into an arc,
/// the curves may meet far past the end instead.
bool is_past(PlaneVector end, PlaneVector corner, PlaneVector travel) {
  constexpr double kSlack = 0.0254;  // mm
  return dot(corner - end, travel) > kSlack;
}

/// Ends the held move at `end` (machine) and lets it go with all that came after it.
bool finish_held(Run& run, PlaneVector end, PlaneVector travel) {
  if (run.held.empty()) return true;
  auto& events = run.held.events();
  if (auto* arc = std::get_if<Arc>(&events.front())) {
    if (!end_arc(run, *arc, end)) return run.fail(ErrorCode::CompCorner, 0);
  } else {
    auto* line = std::get_if<Line>(&events.front());
    Position& to = line ? line->to : std::get<Rapid>(events.front()).to;
    if (is_reversed(run, end, travel)) return run.fail(ErrorCode::CompCorner, 0);
    put(run, to, end);
  }
  // Moves after it that do not move in the plane are over the same point.
  for (auto& event : events) {
    if (auto* line = std::get_if<Line>(&event)) put(run, line->to, end);
    if (auto* rapid = std::get_if<Rapid>(&event)) put(run, rapid->to, end);
  }
  release_held(run);
  return true;
}

enum class Corner : std::uint8_t { StraightOn, Convex, Concave };

/// Where the held move ends and the next begins, in machine coordinates; normals point from the
/// path to the tool and have length 1.
struct Entry {
  PlaneVector corner;
  PlaneVector tool;
  PlaneVector normal = {};                                ///< at the start of the next move
  PlaneVector next_start = {};                            ///< of the tool, in program coordinates
  std::optional<Turn> next_turn = {};                     ///< of an arc
  const Target* next = nullptr;                           ///< not at the end of compensation
  PlaneVector old_normal = of_length_one(tool - corner);  ///< at the end of the held move
};

/// A path straight back leads into a valley, not around a point, where the arc beside it (the next
/// move, or else the held one) bulges toward the tool.
bool turns_back_inside(const Run& run, std::optional<Turn> next_turn) {
  if (next_turn) return !is_inside(run, *next_turn);
  const auto* arc = std::get_if<Arc>(&run.held.events().front());
  return arc != nullptr && !is_inside(run, arc->turn);
}

Corner corner_of(const Run& run, const Entry& entry) {
  // A path is straight on, or straight back, up to 0.05 radians; this is their sine.
  constexpr double kStraight = 0.04997916927067833;
  const double sine = side_sign(run) * cross(entry.normal, entry.old_normal);
  if (sine < -kStraight) return Corner::Concave;
  if (sine > kStraight) return Corner::Convex;
  if (dot(entry.normal, entry.old_normal) > 0) return Corner::StraightOn;
  return turns_back_inside(run, entry.next_turn) ? Corner::Concave : Corner::Convex;
}

/// Direction in which the held move arrives at the corner, of length 1.
PlaneVector travel_of(const Run& run, const Entry& entry) {
  return -side_sign(run) * left_of(entry.old_normal);
}

/// About the programmed corner, at the height where the held moves end; not held itself.
bool make_corner(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  const bool is_lathe = run.state.compensation.orientation != 0;
  if (is_lathe) run.held.on_block_end({});  // makes it the sink
  bool ok = true;
  if (is_rapid) {
    rapid_to(run, target);
  } else {
    const PlaneVector center = programmed_point(run);
    const PlaneVector to = point_of(run, target.to);
    const double sweep = sweep_of(center, tool_point(run), to, corner_turn(run));
    ok = arc_to(run, target, {center.first, center.second, corner_turn(run), sweep}, feed);
  }
  if (is_lathe) {
    run.held.events().erase(run.held.events().begin());
    release_held(run);
  }
  return ok;
}

/// Which of two points the tool leaves the held curve at. A line ends where it first reaches a
/// circle that it must stay outside of, and where it last crosses one that it must stay inside of;
/// a line that begins, the reverse. The nearer point may be the other, where the path doubles back.
PlaneVector leaving_point(const Run& run, const Entry& entry, const OffsetCurve& next,
                          const Meeting& meeting, PlaneVector travel) {
  const auto [a, b] = meeting.points;
  if (meeting.count == 1) return a;
  const auto* held = std::get_if<Arc>(&run.held.events().front());
  const bool is_inside_held = held != nullptr && is_inside(run, held->turn);
  if (held != nullptr && next.is_circle) {
    const PlaneVector left = left_of(next.at - center_of(*held));
    const bool is_left = is_inside_held == (*entry.next_turn == Turn::Counterclockwise);
    return (dot(a - b, left) > 0) == is_left ? a : b;
  }
  const PlaneVector along = held != nullptr ? next.along : travel;
  const bool is_last = held != nullptr ? !is_inside_held : is_inside(run, *entry.next_turn);
  return (dot(a - b, along) > 0) == is_last ? a : b;
}

/// Makes the corner between the held move and the next, whose offset curve is `next`.
bool join(Run& run, const Entry& entry, const OffsetCurve& next, bool is_rapid, const Feed& feed) {
  const PlaneVector travel = travel_of(run, entry);
  switch (corner_of(run, entry)) {
    case Corner::StraightOn:
      return finish_held(run, entry.tool, travel);
    case Corner::Convex:
      return finish_held(run, entry.tool, travel) &&
             make_corner(run, corner_end(run, *entry.next, entry.next_start), is_rapid, feed);
    case Corner::Concave:
      break;
  }
  const Meeting meeting = meet(held_curve(run, entry.tool, entry.old_normal), next);
  if (meeting.count == 0) {
    return run.fail(next.is_circle ? ErrorCode::CompCorner : ErrorCode::CompZeroCorner, 0);
  }
  const PlaneVector best = leaving_point(run, entry, next, meeting, travel);
  if (is_past(entry.tool, best, travel)) return run.fail(ErrorCode::CompCorner, 0);
  if (!finish_held(run, best, travel)) return false;
  // The next move begins where the held one ended now.
  Axes machine = values_of(run.state.machine);
  const PlaneAxes plane = axes_of(run.state.modes.plane);
  machine[index_of(plane.first)] = best.first;
  machine[index_of(plane.second)] = best.second;
  run.state.position = to_program(run, machine);
  put(run, run.state.machine, best);
  return true;
}

/// From here on events wait after the move that is about to be made.
class Hold {
 public:
  explicit Hold(Run& run) : run_(run) {
    run_.events();  // the header
    start_ = run_.state.machine;
  }
  void line(const Target& target, bool is_rapid, const Feed& feed) {
    const Position& to = arrive(run_, target);
    run_.held.begin(start_);
    if (is_rapid) {
      run_.held.on_rapid({run_.origin, to, run_.rests_at_end()});
    } else {
      run_.held.on_line({run_.origin, to, feed, run_.rests_at_end()});
    }
  }
  /// An arc is made as any other, with the queue as its sink.
  bool arc(const Target& target, const ArcShape& shape, const Feed& feed) {
    run_.held.begin(start_);
    run_.held.on_block_end({});  // makes it the sink
    const bool ok = arc_to(run_, target, shape, feed);
    run_.held.events().erase(run_.held.events().begin());
    return ok;
  }

 private:
  Run& run_;
  Position start_;
};

bool check_room(Run& run) {
  if (!run.held.is_full()) return true;
  return run.fail(ErrorCode::CompTooLong, 0, fmt::format("more than {}", HeldEvents::kMax));
}

bool enter_on_line(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  const double radius = run.state.compensation.radius;
  const PlaneVector tool = tool_point(run);
  const PlaneVector end = point_of(run, target.to);
  if (distance(tool, end) <= radius) return run.fail(ErrorCode::CompEntry, 0);
  const double normal = direction(tool, end) + side_sign(run) * kQuarter;
  Hold(run).line(moved_to(run, target, along(end, normal, radius)), is_rapid, feed);
  programmed_at(run, end);
  return true;
}

/// The offset arc must begin where the tool is: its center moves along the end's normal.
bool enter_on_arc(Run& run, const Target& target, PlaneVector center, Turn turn,
                  double full_circles, const Feed& feed) {
  if (run.state.compensation.orientation != 0) {
    return run.fail(ErrorCode::CompLathe, 0, "the entry move is an arc");
  }
  const double radius = run.state.compensation.radius;
  const PlaneVector tool = tool_point(run);
  const PlaneVector end = point_of(run, target.to);
  if (run.state.compensation.was_on) return run.fail(ErrorCode::CompExit, 0);
  // A full circle is shorter still: it would shrink to the little arc that leads to its offset.
  if (distance(tool, end) <= radius) return run.fail(ErrorCode::CompEntry, 0);
  if (distance(center, end) <= radius) return run.fail(ErrorCode::CompArcRadius, 0);
  const double inward = direction(end, center);
  const PlaneVector stop = along(end, is_inside(run, turn) ? inward : inward + Angle::kPi, radius);
  const double toward_center = direction(stop, center);
  const double cosine = std::cos(direction(stop, tool) - toward_center);
  if (std::fabs(cosine) < 1e-6) return run.fail(ErrorCode::CompArcRadius, 0);
  const PlaneVector moved = along(stop, toward_center, distance(tool, stop) / 2 / cosine);
  const double once = sweep_of(moved, tool, stop, turn);
  const double sweep = once + 360 * (full_circles - 1);
  run.state.compensation.held_sweep = once;
  if (!Hold(run).arc(moved_to(run, target, stop), {moved.first, moved.second, turn, sweep}, feed)) {
    return false;
  }
  programmed_at(run, end);
  return true;
}

}  // namespace

bool trimmed_line(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  const Compensation& compensation = run.state.compensation;
  if (!check_room(run)) return false;
  if (compensation.is_first) return enter_on_line(run, target, is_rapid, feed);
  const PlaneVector start = programmed_point(run);
  const PlaneVector end = point_of(run, target.to);
  if (end == start) {
    move_to(run, moved_to(run, target, tool_point(run)), is_rapid, feed);
    return true;
  }
  const PlaneVector heading = of_length_one(end - start);
  const PlaneVector normal = side_sign(run) * left_of(heading);
  const PlaneVector aside = compensation.radius * normal;
  if (!run.held.empty()) {
    const PlaneFrame frame(run);
    const Entry entry{.corner = frame.machine_point(start),
                      .tool = frame.machine_point(tool_point(run)),
                      .normal = frame.machine_direction(normal),
                      .next_start = start + aside,
                      .next_turn = std::nullopt,
                      .next = &target};
    const OffsetCurve next{.at = frame.machine_point(end + aside),
                           .along = frame.machine_direction(heading)};
    if (!join(run, entry, next, is_rapid, feed)) return false;
  }
  Hold(run).line(moved_to(run, target, end + aside), is_rapid, feed);
  programmed_at(run, end);
  return true;
}

bool trimmed_arc(Run& run, const Target& target, PlaneVector center, Turn turn, double full_circles,
                 const Feed& feed) {
  const Compensation& compensation = run.state.compensation;
  if (!check_room(run)) return false;
  if (compensation.is_first) return enter_on_arc(run, target, center, turn, full_circles, feed);
  const PlaneVector start = programmed_point(run);
  const PlaneVector end = point_of(run, target.to);
  const bool inside = is_inside(run, turn);
  const double radius = length(end - center);
  if (inside && radius <= compensation.radius) return run.fail(ErrorCode::CompArcRadius, 0);
  const double path = inside ? radius - compensation.radius : radius + compensation.radius;
  if (!run.held.empty()) {
    const PlaneFrame frame(run);
    const PlaneVector outward = of_length_one(start - center);
    const PlaneVector normal = inside ? -outward : outward;
    const Entry entry{.corner = frame.machine_point(start),
                      .tool = frame.machine_point(tool_point(run)),
                      .normal = frame.machine_direction(normal),
                      .next_start = start + compensation.radius * normal,
                      .next_turn = turn,
                      .next = &target};
    const OffsetCurve next{
        .is_circle = true, .at = frame.machine_point(center), .along = {}, .radius = path};
    if (!join(run, entry, next, false, feed)) return false;
  }
  const PlaneVector stop = center + (path / radius) * (end - center);
  const double sweep = sweep_of(center, tool_point(run), stop, turn) + 360 * (full_circles - 1);
  if (!Hold(run).arc(moved_to(run, target, stop), {center.first, center.second, turn, sweep},
                     feed)) {
    return false;
  }
  run.state.compensation.held_sweep = sweep_of(center, start, end, turn);
  programmed_at(run, end);
  return true;
}

void continue_from_tool(Run& run) {
  State& state = run.state;
  const Compensation& compensation = state.compensation;
  if (!compensation.was_on) return;
  Axes machine = values_of(state.machine);
  std::copy(compensation.left.begin(), compensation.left.end(), machine.begin());
  state.position = to_program(run, machine);
  state.machine = to_machine(run, state.position);
  state.is_displaced = false;
}

bool stop_trimming(Run& run) {
  Compensation& compensation = run.state.compensation;
  if (compensation.is_first) return true;
  const PlaneFrame frame(run);
  const Entry end{.corner = frame.machine_point(programmed_point(run)),
                  .tool = frame.machine_point(tool_point(run))};
  if (!finish_held(run, end.tool, travel_of(run, end))) return false;
  Position tool = run.state.machine;
  put(run, tool, end.tool);
  for (std::size_t i = 0; i < 3; ++i) compensation.left[i] = tool.raw(kAllAxes[i]);
  const PlaneAxes plane = axes_of(run.state.modes.plane);
  run.state[plane.first] = compensation.x;
  run.state[plane.second] = compensation.y;
  run.state.machine = to_machine(run, run.state.position);
  compensation.was_on = true;
  run.state.is_displaced = true;
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
