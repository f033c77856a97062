#include <fmt/core.h>
#include <cmath>
#include <string>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/approach_geometry.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"

/// APPR and DEP. Source: TNC 410, TNC 426 and iTNC 530, User's Manuals: contour approach and
/// departure. The tool's center goes to the auxiliary point with the feed (or FMAX) of the block
/// before, with LCT that of the block, then to its own place at the first contour point with the
/// feed of the block. LEN is the length of the second of these moves, for LN after the tool's
/// radius; R is the radius of its arc: the manuals' examples have R5 with tools of 7.5 to 12.5.
namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr std::uint8_t kNormal = 1, kCircle = 2, kLineAndCircle = 3;

bool is_by_circle(const Block& block) {
  return block.part >= kCircle;
}

bool refuse(Run& run, std::string_view what) {
  return run.fail(ErrorCode::NotSupported, what);
}

Block straight(Compensation side) {
  Block block;
  block.clear(BlockKind::Line);
  block.compensation = side;
  return block;
}

bool go(Run& run, Compensation side, const Target& target, const Pace& pace) {
  const Block block = straight(side);
  const PlaneMove move = plane_move(run.state, target);
  if (!begin_move(run, block, move)) return false;
  line_to(run, target, pace);
  return finish_move(run, block, move);
}

Target target_in_plane(const State& state, PlaneVector to) {
  Target target = here(state);
  set_in_plane(state, target, to);
  name_plane(state, target);
  return target;
}

/// Where the tool axis goes, beside the plane; false: another axis is programmed.
bool read_height(Run& run, const Target& target, bool& has_height) {
  const PlaneAxes axes = axes_of(run.state.plane);
  const AxisMask plane = static_cast<AxisMask>(bit(axes.first) | bit(axes.second));
  const AxisMask rest = static_cast<AxisMask>(target.named & ~plane);
  has_height = rest == bit(run.state.tool.axis);
  return has_height || rest == 0 ||
         refuse(run, "APPR and DEP with an axis that is neither of the plane nor of the tool");
}

bool check_modes(Run& run, const Block& block, std::string_view name) {
  const State& state = run.state;
  if (!refuse_before_positioning(run, name)) return false;
  if (block.m != Block::kNone) return refuse(run, fmt::format("{} with M{}", name, block.m));
  if (!state.tool.is_called) return run.fail(ErrorCode::ToolCallMissing, name);
  if (state.transformation.turns_over(state.plane)) {
    return refuse(run, fmt::format("{} in a mirror image", name));
  }
  if (state.pole_plane) return refuse(run, fmt::format("{} after CC with the tool axis", name));
  if (state.blend.kind != BlendKind::None || state.joins || run.blend_follows) {
    return refuse(run, fmt::format("RND or CHF before or after {}", name));
  }
  return check_circle_plane(run);
}

bool go_around(Run& run, const TangentArc& arc, PlaneVector to, double sweep, const Pace& pace) {
  constexpr double kNoAngle = 1e-7;
  if (sweep < kNoAngle) return true;
  Block block;
  block.clear(BlockKind::Arc);
  block.compensation = Compensation::Off;
  const ArcTarget target{target_in_plane(run.state, to), arc.center, arc.turn, sweep};
  PlaneMove move = plane_move(run.state, target.to);
  move.is_arc = move.has_any = move.has_both = move.has_travel = true;
  move.center = arc.center;
  move.turn = arc.turn;
  if (!begin_move(run, block, move)) return false;
  arc_to(run, target, pace);
  return finish_move(run, block, move);
}

/// From the contour's point to the auxiliary point, for the tool's center. `sign`: 1 after the end,
/// -1 before the begin.
PlaneVector offset(Run& run, const Block& block, Compensation side, PlaneVector along,
                   double sign) {
  const State& state = run.state;
  const double distance = run.length(run.parts.itnc.length);
  const double radius = state.tool.data.radius / state.transformation.factor(state.plane);
  const PlaneVector normal = (side == Compensation::Left ? 1.0 : -1.0) * left_of(along);
  if (block.part == kNormal) return (radius + distance) * normal;
  return radius * normal + (sign * distance) * along;
}

bool check_sizes(Run& run, const Block& block, std::string_view name) {
  const auto refuse_size = [&](std::string_view word, double value, std::string_view range) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("{} {} of {} is not {}", word, value, name, range));
  };
  if (!is_by_circle(block)) {
    const double distance = run.length(run.parts.itnc.length);
    return distance > 0 || refuse_size("LEN", distance, "above 0");
  }
  const double radius = run.length(run.parts.itnc.arc_radius);
  if (block.part == kLineAndCircle) return radius > 0 || refuse_size("R", radius, "above 0");
  const double angle = run.number(run.parts.itnc.center_angle);
  if (radius == 0) return refuse_size("R", radius, "above or below 0");
  return (angle > 0 && angle <= 360) || refuse_size("CCA", angle, "above 0, up to 360");
}

/// Coordinates, or PR and PA; LEN, R and CCA are read where they are used.
bool read_point(Run& run, const Block& block, Target& target) {
  if (!run.parts.itnc.is_polar) {
    read_coordinates(run, block, target);
    run.state.polar.is_current = false;
    return true;
  }
  if (!run.state.has_pole) return run.fail(ErrorCode::AngleReferenceMissing, "no CC before");
  const PlaneAxes axes = axes_of(run.state.plane);
  if (block.names(axes.first) || block.names(axes.second)) {
    return run.fail(ErrorCode::BlockFormatIncorrect, "coordinates of the plane beside PR and PA");
  }
  if (!read_polar(run, block, target)) return false;
  name_plane(run.state, target);
  return true;
}

/// Of LCT. From the contour's other side the tool would cross it, and go nearly all around.
bool check_far_point(Run& run, const TangentArc& arc, PlaneVector point, std::string_view what) {
  constexpr double kSamePlace = 1e-6;
  const double away = length(point - arc.center);
  const double beyond = dot(point - arc.at, arc.at - arc.center) / arc.radius;
  if (away >= arc.radius - kSamePlace && beyond <= kSamePlace) return true;
  const std::string where =
      beyond > kSamePlace
          ? fmt::format("{:.3f} beyond the contour, whose other side the arc is on", beyond)
          : fmt::format("{:.3f} from the center of the arc, within its R {:.3f}", away, arc.radius);
  return run.fail(ErrorCode::EntryOutOfRange, fmt::format("{} is {}", what, where));
}

Pace pace_before(const State& state) {
  return state.is_rapid_next ? kRapid : Pace{false, state.feed, state.rotary_feed};
}

bool move_height(Run& run, const Target& wanted, const Pace& pace) {
  const Axis axis = run.state.tool.axis;
  Target target = here(run.state);
  target.set(axis, wanted.at[static_cast<std::size_t>(axis)]);
  return go(run, Compensation::Off, target, pace);
}

bool use_feed(Run& run, const Block& block, Pace& pace) {
  State& state = run.state;
  if (run.parts.itnc.is_auto_feed) {
    if (!(state.tool_feed > 0)) {
      return run.fail(ErrorCode::FeedRateMissing, "F AUTO, and TOOL CALL had no F");
    }
    state.feed = state.tool_feed;
    state.rotary_feed = rotary_feed_of(run, state.feed);
  }
  return read_feed(run, block) && pace_of(run, block, pace);
}

/// To the auxiliary point, down, and to the contour's point.
bool approach_straight(Run& run, const Block& block, const Target& target, PlaneVector along,
                       const Pace& before, bool has_height) {
  State& state = run.state;
  const PlaneVector begin = in_plane(state, target);
  const PlaneVector to = begin + offset(run, block, block.compensation, along, -1);
  if (!go(run, Compensation::Off, target_in_plane(state, to), before)) return false;
  Pace pace;
  if (!use_feed(run, block, pace)) return false;
  if (has_height && !move_height(run, target, pace)) return false;
  state.is_rapid_next = block.is_rapid;
  return go(run, block.compensation, target_in_plane(state, begin), pace);
}

bool approach_by_circle(Run& run, const Block& block, const Target& target, PlaneVector along,
                        const Pace& before, bool has_height) {
  State& state = run.state;
  const PlaneVector begin = in_plane(state, target);
  const TangentArc arc = tangent_arc(run, block.compensation, begin, along);
  Pace pace;
  PlaneVector to;
  double sweep = run.number(run.parts.itnc.center_angle);
  if (block.part == kLineAndCircle) {
    const PlaneVector from = in_plane(state, here(state));
    if (!check_far_point(run, arc, from, "the start of APPR LCT")) return false;
    to = tangent_point(arc, from, true);
    sweep = sweep_between(arc, to, arc.at);
    if (!use_feed(run, block, pace)) return false;
    if (!go(run, Compensation::Off, target_in_plane(state, to), pace)) return false;
  } else {
    to = arc.center + rotated(arc.at - arc.center, -arc.sign() * sweep);
    if (!go(run, Compensation::Off, target_in_plane(state, to), before)) return false;
    if (!use_feed(run, block, pace)) return false;
  }
  if (has_height && !move_height(run, target, pace)) return false;
  state.is_rapid_next = block.is_rapid;
  // Then the tool is beside the contour's point: the contour begins there without a move.
  return go_around(run, arc, arc.at, sweep, pace) &&
         go(run, block.compensation, target_in_plane(state, begin), pace);
}

bool depart_by_circle(Run& run, const Block& block, const Target& target, PlaneVector along,
                      const Pace& pace) {
  State& state = run.state;
  const TangentArc arc = tangent_arc(run, state.compensation, in_plane(state, here(state)), along);
  double sweep = run.number(run.parts.itnc.center_angle);
  PlaneVector to = arc.center + rotated(arc.at - arc.center, arc.sign() * sweep);
  if (block.part == kLineAndCircle) {
    const PlaneVector end = in_plane(state, target);
    if (!check_far_point(run, arc, end, "the end of DEP LCT")) return false;
    to = tangent_point(arc, end, false);
    sweep = sweep_between(arc, arc.at, to);
  }
  // The contour ends beside its point without a move.
  if (state.tool.data.radius == 0) {
    end_contour(run, false);
  } else if (!go(run, Compensation::Off, target_in_plane(state, arc.at), pace)) {
    return false;
  }
  if (!go_around(run, arc, to, sweep, pace)) return false;
  return block.part != kLineAndCircle ||
         go(run, Compensation::Off, target_in_plane(state, in_plane(state, target)), pace);
}

}  // namespace

bool approach(Run& run, const Block& block) {
  State& state = run.state;
  if (!check_modes(run, block, "APPR") || !check_sizes(run, block, "APPR")) return false;
  if (state.is_compensating() || state.is_parallel) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted, "APPR needs R0 before it");
  }
  Target target = here(state);
  if (!read_point(run, block, target)) return false;
  bool has_height = false;
  if (!read_height(run, target, has_height)) return false;
  if (!names_plane(state, target)) {
    return run.fail(ErrorCode::BlockFormatIncorrect, "APPR names both axes of the plane");
  }
  const PlaneVector begin = in_plane(state, target);
  const PlaneVector along =
      run.contour_begin ? begin_direction(run, *run.contour_begin, begin) : PlaneVector{};
  if (length(along) == 0) {
    return refuse(
        run,
        "APPR without L, LP, C or CP in the plane directly after it: its direction is not "
        "known");
  }
  const Compensation next = run.contour_begin->compensation;
  const bool is_compensated = block.compensation != Compensation::NotProgrammed;
  if (next != Compensation::NotProgrammed &&
      next != (is_compensated ? block.compensation : Compensation::Off)) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    "the block after APPR states another radius compensation than APPR");
  }
  const Pace before = pace_before(state);
  if (!before.is_rapid && !(before.feed > 0)) {
    return run.fail(ErrorCode::FeedRateMissing, "no F above 0 before APPR");
  }
  return (is_by_circle(block) ? approach_by_circle : approach_straight)(run, block, target, along,
                                                                        before, has_height);
}

bool depart(Run& run, const Block& block) {
  State& state = run.state;
  if (!check_modes(run, block, "DEP") || !check_sizes(run, block, "DEP")) return false;
  if (!state.is_compensating() || state.awaits_contour) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted, "DEP without a contour before it");
  }
  Target target = here(state);
  if (!read_point(run, block, target)) return false;
  bool has_height = false;
  if (!read_height(run, target, has_height)) return false;
  const bool has_end = block.part == kLineAndCircle;
  if (has_end ? !names_plane(state, target) : target.named != 0 && !has_height) {
    return run.fail(ErrorCode::BlockFormatIncorrect,
                    has_end ? "DEP LCT names both axes of the plane"
                            : "DEP LT, DEP LN and DEP CT have no end point");
  }
  const PlaneVector along = end_direction(state.last);
  constexpr double kSamePlace = 1e-6;
  if (!state.last.exists || length(along) == 0 ||
      length(state.last.to - in_plane(state, here(state))) > kSamePlace) {
    return refuse(run, "DEP without an element of the contour directly before it");
  }
  Pace pace;
  if (!use_feed(run, block, pace)) return false;
  if (is_by_circle(block)) {
    if (!depart_by_circle(run, block, target, along, pace)) return false;
  } else {
    const PlaneVector to =
        in_plane(state, here(state)) + offset(run, block, state.compensation, along, 1);
    if (!go(run, Compensation::Off, target_in_plane(state, to), pace)) return false;
  }
  return !has_height || move_height(run, target, pace);
}

}  // namespace dripline::interpreter::tnc155::itnc
