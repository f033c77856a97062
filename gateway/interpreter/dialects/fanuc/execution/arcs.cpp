#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr double kSamePoint = 1e-6;

bool is_same_point(PlaneVector a, PlaneVector b) {
  return dot(a - b, a - b) <= kSamePoint * kSamePoint;
}

double sweep_of(PlaneVector start, PlaneVector end, PlaneVector center, Turn turn) {
  if (is_same_point(start, end)) return 360;
  double sweep = turn_between(start - center, end - center) * (180.0 / Angle::kPi);
  if (turn == Turn::Clockwise) sweep = -sweep;
  return sweep <= 0 ? sweep + 360 : sweep;
}

/// The words of one arc in program coordinates.
struct ArcWords {
  PlaneAxes axes{};
  Turn turn = Turn::Clockwise;
  Point3 start{};
  Point3 end{};
  PlaneVector center;
};

PlaneVector flat(const ArcWords& arc, const Point3& point) {
  return {point[place(arc.axes.first)], point[place(arc.axes.second)]};
}

constexpr std::array<Address, 3> kOffsetOf{I, J, K};

/// The center of an arc of radius R; the short one when R > 0.
bool center_by_radius(Run& run, double radius, ArcWords& arc) {
  const PlaneVector start = flat(arc, arc.start);
  const PlaneVector end = flat(arc, arc.end);
  const double chord = length(start - end);
  double size = std::fabs(radius);
  if (chord / 2 > size) {
    const double missing = chord / 2 - size;
    if (missing > run.state.parameters.arc_error && !run.options.short_radius_is_semicircle) {
      return run.fail(ErrorCode::IllegalRadius, run.block.words.column(R),
                      fmt::format("R{} does not span {}", run.in_length_units(radius),
                                  run.in_length_units(chord)));
    }
    size = chord / 2;
  }
  const double height = std::sqrt(std::max(0.0, size * size - chord * chord / 4));
  // The center of a short counterclockwise arc lies to the left of the line from start to end.
  const double side = (radius > 0) == (arc.turn == Turn::Clockwise) ? -height : height;
  const double along_first = (end.first - start.first) / chord;
  const double along_second = (end.second - start.second) / chord;
  arc.center = {(start.first + end.first) / 2 - side * along_second,
                (start.second + end.second) / 2 + side * along_first};
  return true;
}

/// The radii at both ends differ by no more than `limit`, found without roots: |a - b| is at most
/// |a^2 - b^2| over the larger. False says nothing.
bool surely_agree(const ArcWords& arc, double limit) {
  const PlaneVector at_start = flat(arc, arc.start) - arc.center;
  const PlaneVector at_end = flat(arc, arc.end) - arc.center;
  const double start_square = dot(at_start, at_start);
  const double end_square = dot(at_end, at_end);
  const double off = start_square - end_square;
  return off * off <= limit * limit * std::max(start_square, end_square);
}

bool center_by_offsets(Run& run, ArcWords& arc) {
  const Words& words = run.block.words;
  arc.center = flat(arc, arc.start);
  const Address first = kOffsetOf[place(arc.axes.first)];
  const Address second = kOffsetOf[place(arc.axes.second)];
  const Address third = kOffsetOf[place(arc.axes.normal)];
  if (words.has(third)) return run.fail(ErrorCode::IllegalPlaneAxis, words.column(third));
  if (words.has(first)) arc.center.first += run.length(words[first]);
  if (words.has(second)) arc.center.second += run.length(words[second]);
  if (is_same_point(arc.center, flat(arc, arc.start))) {
    return run.fail(ErrorCode::NoRadius, words.first_column(kCenterWords),
                    "the center is the start");
  }
  const double limit = run.state.parameters.arc_error;
  if (limit <= 0 || surely_agree(arc, limit)) return true;
  const double error = std::fabs(length(arc.center - flat(arc, arc.start)) -
                                 length(arc.center - flat(arc, arc.end)));
  if (error > limit) {
    return run.fail(ErrorCode::RadiusTolerance, words.first_column(kCenterWords),
                    fmt::format("the end is off by {:.6g}", run.in_length_units(error)));
  }
  return true;
}

/// In G93, F is the speed over the radius, not the number of moves per minute.
Feed feed_on_arc(const Run& run, double radius) {
  if (!run.state.is_inverse_time()) [[likely]]
    return run.active_feed();
  return Feed::per_minute(Length::mm(run.state.inverse_feed * radius));
}

/// An arc of the machine's axes.
Arc arc_about(const Run& run, const PlaneAxes& axes, PlaneVector middle, Turn turn,
              const Position& end) {
  const PlaneVector start = in_plane(run.state.position, axes);
  const PlaneVector stop = in_plane(end, axes);
  return {.origin = run.origin,
          .to = end,
          .center_first = Length::mm(middle.first),
          .center_second = Length::mm(middle.second),
          .plane = run.state.plane(),
          .turn = turn,
          .sweep = Angle::degrees(sweep_of(start, stop, middle, turn)),
          .feed = feed_on_arc(run, length(middle - start)),
          .rests = run.rests_at_end()};
}

Turn other(Turn turn) {
  return turn == Turn::Clockwise ? Turn::Counterclockwise : Turn::Clockwise;
}

/// G51 has factors of different size along the axes of the plane.
bool is_scaled_unevenly(const ModalState& state, const PlaneAxes& axes) {
  const std::array<double, 3>& factor = state.scaling.factor;
  return state.g[kScalingGroup] == 51 &&
         std::fabs(factor[place(axes.first)]) != std::fabs(factor[place(axes.second)]);
}

/// Series 16 and what descends from it. The 15i makes I, J, K of R and scales those instead; of the
/// other models it is not known.
bool scales_radius(Model model) {
  return model == Model::M16 || model == Model::I0 || model == Model::I16 || model == Model::I18 ||
         model == Model::I21;
}

/// R with the larger of the factors, to the scaled end.
bool move_on_scaled_radius(Run& run, ArcWords arc, const Position& end) {
  const ModalState& state = run.state;
  const double first = state.scaling.factor[place(arc.axes.first)];
  const double second = state.scaling.factor[place(arc.axes.second)];
  const std::uint32_t column = run.block.words.column(R);
  if (!scales_radius(run.options.model)) {
    return run.fail(ErrorCode::IllegalRadius, column,
                    "R under unequal factors of G51, which differs between controls; I, J, K do "
                    "not");
  }
  if (first < 0 || second < 0) {
    return run.fail(ErrorCode::IllegalRadius, column,
                    "R under unequal factors of G51 of which one is negative");
  }
  for (const Axis axis : {arc.axes.first, arc.axes.second}) {
    arc.start[place(axis)] = state.position.raw(axis);
    arc.end[place(axis)] = end.raw(axis);
  }
  if (is_plane_mirrored(state, state.plane())) arc.turn = other(arc.turn);
  const double radius = run.length(run.block.words[R]) * std::fmax(first, second);
  if (!center_by_radius(run, radius, arc)) return false;
  return arc_to(run, arc_about(run, arc.axes, arc.center, arc.turn, end));
}

/// An end that unequal factors have put off the circle is reached straight.
bool emit(Run& run, const ArcWords& words, const Position& end) {
  ModalState& state = run.state;
  Point3 center = words.start;
  center[place(words.axes.first)] = words.center.first;
  center[place(words.axes.second)] = words.center.second;
  Turn turn = words.turn;
  if (state.is_transformed) {
    center = transform(state, center);
    if (is_plane_mirrored(state, state.plane())) turn = other(turn);
  }
  const auto in_machine = [&](Axis axis) {
    return center[place(axis)] + state.origin[place(axis)];
  };
  const PlaneVector middle{in_machine(words.axes.first), in_machine(words.axes.second)};
  const PlaneVector start = in_plane(state.position, words.axes);
  const PlaneVector stop = in_plane(end, words.axes);
  Arc arc = arc_about(run, words.axes, middle, turn, end);
  if (!state.is_transformed) return arc_to(run, arc);
  const double radius = length(middle - start);
  const double reach = length(middle - stop);
  const double error = std::fabs(radius - reach);
  if (error <= std::fmax(state.parameters.arc_error, kSamePoint) || reach == 0)
    return arc_to(run, arc);
  arc.rests = false;  // the line to the end does
  arc.to.set_raw(words.axes.first, middle.first + (stop.first - middle.first) * radius / reach);
  arc.to.set_raw(words.axes.second, middle.second + (stop.second - middle.second) * radius / reach);
  return arc_to(run, arc) && line_to(run, end, arc.feed);
}

/// G45 to G48.
bool offsets_end(const Block& block) {
  return block.parts.one_shot >= 45 && block.parts.one_shot <= 48;
}

/// G45 to G48 on a quarter: the radius grows or shrinks with the end.
bool offset_arc(Run& run, ArcWords& arc, Position& end) {
  const PlaneVector start = flat(arc, arc.start);
  const double sweep = sweep_of(start, flat(arc, arc.end), arc.center, arc.turn);
  constexpr double kClose = 1e-3;
  const bool is_quarter = std::fabs(sweep - 90) < kClose || std::fabs(sweep - 270) < kClose;
  if (!is_quarter || run.state.is_transformed || run.block.words.has(R)) {
    return run.fail(ErrorCode::OffsetArc, run.block.parts.g_column);
  }
  const Position plain = end;
  if (!offset_target(run, end)) return false;
  const double change = std::fabs(end.raw(arc.axes.first) - plain.raw(arc.axes.first));
  const double travel = plain.raw(arc.axes.first) - run.state.position.raw(arc.axes.first);
  const double moved = end.raw(arc.axes.first) - run.state.position.raw(arc.axes.first);
  const double grown = std::fabs(moved) < std::fabs(travel) ? -change : change;
  const double radius = length(arc.center - start);
  const double factor = (radius + grown) / radius;
  if (!(factor > 0)) return run.fail(ErrorCode::OffsetArc, run.block.parts.g_column);
  arc.center = {start.first + (arc.center.first - start.first) * factor,
                start.second + (arc.center.second - start.second) * factor};
  return true;
}

}  // namespace

bool move_on_arc(Run& run) {
  const Words& words = run.block.words;
  const ModalState& state = run.state;
  if (!words.has_any(kAxisWords | kCenterWords)) return true;  // R alone: end and start are one
  if (words.has_any(kAxisWords & ~set_of(X, Y, Z)) && !run.rotary.is_on()) {
    return run.fail(ErrorCode::IllegalPlaneAxis, words.first_column(kAxisWords & ~set_of(X, Y, Z)));
  }
  if (state.g[kRotationGroup] == 68 && state.rotation.plane != state.plane()) {
    return run.fail(ErrorCode::RotationPlane, words.first_column(kAxisWords | kCenterWords));
  }
  run.ledger.take(kAxisWords | kCenterWords | set_of(R));  // of R and I J K, R counts
  Position end;
  if (!read_target(run, end) || !check_feed(run)) return false;
  ArcWords arc;
  arc.axes = axes_of(state.plane());
  arc.turn = state.g[kMotionGroup] == 2 ? Turn::Clockwise : Turn::Counterclockwise;
  arc.start = program_position(run);
  arc.end = program_point(state, end);
  if (words.has(R)) {
    if (run.length(words[R]) == 0)
      return run.fail(ErrorCode::IllegalRadius, words.column(R), "R is 0");
    if (is_same_point(flat(arc, arc.start), flat(arc, arc.end))) {
      run.warn(WarningCode::ArcWithoutMove, words.column(R));
      return line_to(run, end, run.active_feed());  // nothing, or the third axis alone
    }
    if (is_scaled_unevenly(state, arc.axes) && !offsets_end(run.block))
      return move_on_scaled_radius(run, arc, end);
    if (!center_by_radius(run, run.length(words[R]), arc)) return false;
  } else if (words.has_any(kCenterWords)) {
    if (!center_by_offsets(run, arc)) return false;
  } else {
    if (run.options.arc_needs_center) {
      return run.fail(ErrorCode::NoRadius, words.first_column(kAxisWords));
    }
    run.warn(WarningCode::ArcAsLine, words.first_column(kAxisWords));
    return line_to(run, end, run.active_feed());
  }
  if (offsets_end(run.block) && !offset_arc(run, arc, end)) return false;
  return emit(run, arc, end);
}

}  // namespace dripline::interpreter::fanuc
