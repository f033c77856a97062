#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"

/// The NIST program compensates line by line: convex corners get an arc, concave ones are refused
/// (NIST appendix B).
namespace dripline::interpreter::rs274ngc {
namespace {

/// Radians; corners this small are none.
constexpr double kNoCorner = 0.01;

enum class CornerKind : std::uint8_t { StraightOn, Convex, Concave };

/// Rotates the tool's normal from where it is to `normal`.
CornerKind corner_to(const Run& run, double normal) {
  const double old_normal = direction(programmed_point(run), tool_point(run));
  const double turn = turned_into(side_sign(run) * (old_normal - normal), -kNoCorner);
  if (turn <= kNoCorner) return CornerKind::StraightOn;
  return turn <= Angle::kPi + kNoCorner ? CornerKind::Convex : CornerKind::Concave;
}

/// Both parts of a move with a corner arc share its time.
Feed part_of(const Feed& feed, double length, double total) {
  if (feed.per() != Feed::Per::Move || length <= 0) return feed;
  return Feed::inverse_time(feed.moves_per_minute() * total / length);
}

struct CornerArc {
  bool is_needed = false;
  PlaneVector end;
  double sweep = 0;
};

CornerArc plan_corner(const Run& run, CornerKind corner, double normal) {
  CornerArc arc;
  if (corner != CornerKind::Convex) return arc;
  arc.is_needed = true;
  const PlaneVector center = programmed_point(run);
  arc.end = along(center, normal, run.state.compensation.radius);
  arc.sweep = sweep_of(center, tool_point(run), arc.end, corner_turn(run));
  return arc;
}

/// About the programmed corner, at the height where the tool is.
bool make_corner(Run& run, const CornerArc& arc, const Target& next, const Feed& feed) {
  const PlaneVector center = programmed_point(run);
  return arc_to(run, corner_end(run, next, arc.end),
                {center.first, center.second, corner_turn(run), arc.sweep}, feed);
}

/// The line from the programmed point stays tangent to the tool where it begins.
bool nist_entry_on_line(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  const double radius = run.state.compensation.radius;
  const PlaneVector tool = tool_point(run);
  const PlaneVector end = point_of(run, target.to);
  const double length = distance(tool, end);
  if (length <= radius) {
    return run.fail(ErrorCode::Gouging, 0, "the first move is not longer than the tool radius");
  }
  const double normal = direction(end, tool) - side_sign(run) * std::acos(radius / length);
  move_to(run, moved_to(run, target, along(end, normal, radius)), is_rapid, feed);
  programmed_at(run, end);
  return true;
}

double corner_length(const Run& run, const CornerArc& arc) {
  return arc.is_needed ? run.state.compensation.radius * arc.sweep * (Angle::kPi / 180) : 0;
}

}  // namespace

bool nist_line(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  const double radius = run.state.compensation.radius;
  const PlaneVector end = point_of(run, target.to);
  if (radius == 0) {
    move_to(run, target, is_rapid, feed);
    programmed_at(run, end);
    return true;
  }
  if (run.state.compensation.is_first) return nist_entry_on_line(run, target, is_rapid, feed);
  const PlaneVector start = programmed_point(run);
  if (end == start) {
    move_to(run, moved_to(run, target, tool_point(run)), is_rapid, feed);
    return true;
  }
  const double normal = direction(start, end) + side_sign(run) * kQuarter;
  const CornerKind corner = corner_to(run, normal);
  if (corner == CornerKind::Concave) return run.fail(ErrorCode::ConcaveCorner, 0);
  const CornerArc arc = is_rapid ? CornerArc{} : plan_corner(run, corner, normal);
  const double arc_length = corner_length(run, arc);
  const double length = distance(start, end);
  if (arc.is_needed &&
      !make_corner(run, arc, target, part_of(feed, arc_length, arc_length + length))) {
    return false;
  }
  move_to(run, moved_to(run, target, along(end, normal, radius)), is_rapid,
          part_of(feed, length, arc_length + length));
  programmed_at(run, end);
  return true;
}

namespace {

/// Center of the arc of radius R through the programmed end that touches the tool where it is.
bool entry_center_of_radius(Run& run, PlaneVector end, Turn turn, PlaneVector& center) {
  const double tool_radius = run.state.compensation.radius;
  const double written = run.mm(run.block.words['R']);
  const double radius = std::fabs(written);
  const bool inside = is_inside(run, turn);
  if (inside && radius <= tool_radius) return run.fail_word(ErrorCode::CompArcRadius, 'R');
  const PlaneVector tool = tool_point(run);
  const double to_tool = inside ? radius - tool_radius : radius + tool_radius;
  const double apart = distance(tool, end);
  // Triangle tool, end, center with all sides known.
  const double cosine =
      (apart * apart + to_tool * to_tool - radius * radius) / (2 * apart * to_tool);
  if (!(std::fabs(cosine) <= 1)) return run.fail_word(ErrorCode::ArcRadiusTooSmall, 'R');
  const double base = direction(tool, end);
  for (const double side : {1.0, -1.0}) {
    center = along(tool, base + side * std::acos(cosine), to_tool);
    const bool is_short = sweep_of(center, tool, end, turn) <= 180;
    if (is_short == (written > 0)) return true;
  }
  return true;
}

bool nist_entry_on_arc(Run& run, const Target& target, PlaneVector center, Turn turn,
                       double full_circles, const Feed& feed) {
  const double tool_radius = run.state.compensation.radius;
  const PlaneVector tool = tool_point(run);
  const PlaneVector end = point_of(run, target.to);
  if (distance(tool, end) <= tool_radius) {
    return run.fail(ErrorCode::Gouging, 0, "the first move is not longer than the tool radius");
  }
  const bool inside = is_inside(run, turn);
  if (run.block.words.has('R') && !entry_center_of_radius(run, end, turn, center)) return false;
  const double radius = distance(center, end);
  if (inside && radius <= tool_radius) return run.fail(ErrorCode::CompArcRadius, 0);
  const double wanted = inside ? radius - tool_radius : radius + tool_radius;
  const double off = std::fabs(distance(center, tool) - wanted);
  const double most = run.state.units == Units::Inch ? 0.0002 * Length::kMillimetersPerInch : 0.002;
  if (off > most) {
    return run.fail(
        ErrorCode::ArcRadiusDiffers, 0,
        fmt::format("the first arc with compensation is off by {}", off / run.state.mm_per_unit()));
  }
  const PlaneVector stop = along(center, direction(center, end), wanted);
  const double sweep = sweep_of(center, tool, stop, turn) + 360 * (full_circles - 1);
  if (!arc_to(run, moved_to(run, target, stop), {center.first, center.second, turn, sweep}, feed)) {
    return false;
  }
  programmed_at(run, end);
  return true;
}

}  // namespace

bool nist_arc(Run& run, const Target& target, PlaneVector center, Turn turn, double full_circles,
              const Feed& feed) {
  const Compensation& compensation = run.state.compensation;
  if (compensation.is_first)
    return nist_entry_on_arc(run, target, center, turn, full_circles, feed);
  const PlaneVector start = programmed_point(run);
  const PlaneVector end = point_of(run, target.to);
  const bool inside = is_inside(run, turn);
  const double radius = distance(center, end);
  if (inside && radius <= compensation.radius) return run.fail(ErrorCode::CompArcRadius, 0);
  const double outward = direction(center, start);
  const double normal = inside ? outward + Angle::kPi : outward;
  const CornerKind corner =
      compensation.radius == 0 ? CornerKind::StraightOn : corner_to(run, normal);
  if (corner == CornerKind::Concave) return run.fail(ErrorCode::ConcaveCorner, 0);
  const CornerArc arc = plan_corner(run, corner, normal);
  const double sweep = sweep_of(center, start, end, turn) + 360 * (full_circles - 1);
  const double path = inside ? radius - compensation.radius : radius + compensation.radius;
  const double length = path * sweep * (Angle::kPi / 180);
  const double arc_length = corner_length(run, arc);
  if (arc.is_needed &&
      !make_corner(run, arc, target, part_of(feed, arc_length, arc_length + length))) {
    return false;
  }
  const PlaneVector stop = along(center, direction(center, end), path);
  if (!arc_to(run, moved_to(run, target, stop), {center.first, center.second, turn, sweep},
              part_of(feed, length, arc_length + length))) {
    return false;
  }
  programmed_at(run, end);
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
