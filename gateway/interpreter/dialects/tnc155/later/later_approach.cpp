#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/later/later_execution.hpp"

/// APPR and DEP on straight lines. Source: TNC 410, TNC 426 and iTNC 530, User's Manuals: contour
/// approach and departure. The tool's center goes to the auxiliary point with the feed (or FMAX) of
/// the block before, then to its own place at the first contour point with the feed of the block;
/// LEN is the length of the second of these moves, for LN after the tool's radius.
namespace dripline::interpreter::tnc155::later {
namespace {

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

/// The direction in which the contour leaves `from`: of length 1; (0, 0) where it is not known.
PlaneVector begin_direction(Run& run, const Block& next, PlaneVector from) {
  const State& state = run.state;
  if (next.kind == BlockKind::Arc && state.has_pole) {
    const PlaneVector out = from - pole_in_plane(state);
    const double radius = length(out);
    if (radius == 0) return {};
    const double sign = next.turn == Turn::Clockwise ? -1 : 1;
    return (sign / radius) * left_of(out);
  }
  if (next.kind != BlockKind::Line || next.m != Block::kNone) return {};
  const PlaneAxes axes = axes_of(state.plane);
  PlaneVector to = from;
  for (const Coordinate& word : next.words()) {
    const double value = run.coordinate(word.axis, word.value);
    if (word.axis == axes.first) to.first = value + (word.is_incremental ? from.first : 0);
    if (word.axis == axes.second) to.second = value + (word.is_incremental ? from.second : 0);
  }
  const PlaneVector path = to - from;
  const double distance = length(path);
  constexpr double kNoTravel = 1e-6;
  if (distance < kNoTravel) return {};
  return (1 / distance) * path;
}

/// From the contour's point to the auxiliary point, for the tool's center. `sign`: 1 after the end,
/// -1 before the begin.
PlaneVector offset(Run& run, const Block& block, Compensation side, PlaneVector along,
                   double sign) {
  const State& state = run.state;
  const double distance = run.length(run.parts.later.length);
  const double radius = state.tool.data.radius / state.transformation.factor(state.plane);
  const PlaneVector normal = (side == Compensation::Left ? 1.0 : -1.0) * left_of(along);
  if (block.part == 1) return (radius + distance) * normal;
  return radius * normal + (sign * distance) * along;
}

bool check_length(Run& run, std::string_view name) {
  const double distance = run.length(run.parts.later.length);
  return distance > 0 || run.fail(ErrorCode::EntryOutOfRange,
                                  fmt::format("LEN {} of {} is not above 0", distance, name));
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
  if (run.parts.later.is_auto_feed) {
    if (!(state.tool_feed > 0)) {
      return run.fail(ErrorCode::FeedRateMissing, "F AUTO, and TOOL CALL had no F");
    }
    state.feed = state.rotary_feed = state.tool_feed;
  }
  return read_feed(run, block) && pace_of(run, block, pace);
}

}  // namespace

bool approach(Run& run, const Block& block) {
  State& state = run.state;
  if (!check_modes(run, block, "APPR") || !check_length(run, "APPR")) return false;
  if (state.is_compensating() || state.is_parallel) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted, "APPR needs R0 before it");
  }
  Target target = here(state);
  read_coordinates(run, block, target);
  bool has_height = false;
  if (!read_height(run, target, has_height)) return false;
  if (!names_plane(state, target)) {
    return run.fail(ErrorCode::BlockFormatIncorrect, "APPR names both axes of the plane");
  }
  const PlaneVector begin = in_plane(state, target);
  const PlaneVector along =
      run.contour_begin ? begin_direction(run, *run.contour_begin, begin) : PlaneVector{};
  if (length(along) == 0) {
    return refuse(run,
                  "APPR without L or C in the plane directly after it: its direction is not "
                  "known");
  }
  const Pace before = pace_before(state);
  if (!before.is_rapid && !(before.feed > 0)) {
    return run.fail(ErrorCode::FeedRateMissing, "no F above 0 before APPR");
  }
  const PlaneVector to = begin + offset(run, block, block.compensation, along, -1);
  if (!go(run, Compensation::Off, target_in_plane(state, to), before)) return false;
  Pace pace;
  if (!use_feed(run, block, pace)) return false;
  if (has_height && !move_height(run, target, pace)) return false;
  state.polar.is_current = false;
  state.is_rapid_next = block.is_rapid;
  return go(run, block.compensation, target_in_plane(state, begin), pace);
}

bool depart(Run& run, const Block& block) {
  State& state = run.state;
  if (!check_modes(run, block, "DEP") || !check_length(run, "DEP")) return false;
  if (!state.is_compensating() || state.awaits_contour) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted, "DEP without a contour before it");
  }
  Target target = here(state);
  read_coordinates(run, block, target);
  bool has_height = false;
  if (!read_height(run, target, has_height)) return false;
  if (target.named != 0 && !has_height) {
    return run.fail(ErrorCode::BlockFormatIncorrect, "DEP LT and DEP LN have no end point");
  }
  const PlaneVector along = end_direction(state.last);
  constexpr double kSamePlace = 1e-6;
  if (!state.last.exists || length(along) == 0 ||
      length(state.last.to - nominal_in_plane(state)) > kSamePlace) {
    return refuse(run, "DEP without an element of the contour directly before it");
  }
  const PlaneVector to = nominal_in_plane(state) + offset(run, block, state.compensation, along, 1);
  Pace pace;
  if (!use_feed(run, block, pace)) return false;
  state.polar.is_current = false;
  if (!go(run, Compensation::Off, target_in_plane(state, to), pace)) return false;
  return !has_height || move_height(run, target, pace);
}

}  // namespace dripline::interpreter::tnc155::later
