#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/shown_length.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr double kFastest = 15'999;     ///< millimeters per minute
constexpr double kFastestInch = 6'299;  ///< tenths of an inch per minute
constexpr double kFastestLater = 99'999.999;
constexpr double kFastestItncInch = 39'370;
constexpr double kTenthsPerInch = 10;

/// Where the present nominal position is, seen from the pole; on it there is a radius, and no
/// angle.
bool renew_polar(Run& run, bool needs_angle) {
  State& state = run.state;
  const PlaneVector out = nominal_in_plane(state) - pole_in_plane(state);
  const double radius = length(out);
  if (radius == 0 && needs_angle) {
    return run.fail(ErrorCode::AngleReferenceMissing, "the tool is on CC");
  }
  state.polar.radius = radius;
  state.polar.angle = turn_between({1, 0}, out) * (180 / Angle::kPi);
  state.polar.is_current = true;
  return true;
}

}  // namespace

bool read_polar(Run& run, const Block& block, Target& target) {
  State& state = run.state;
  PolarData& polar = state.polar;
  const bool misses_one = !block.radius.is_programmed() || !block.angle.is_programmed();
  if (misses_one && !polar.exists) {
    return run.fail(ErrorCode::AngleReferenceMissing, "PR or PA was never programmed");
  }
  const bool needs_last = misses_one || block.is_radius_incremental || block.is_angle_incremental;
  const bool needs_angle = !block.angle.is_programmed() || block.is_angle_incremental;
  if (needs_last && !polar.is_current && !renew_polar(run, needs_angle)) return false;
  double radius = polar.radius;
  double angle = polar.angle;
  if (block.radius.is_programmed()) {
    const double read = run.length(block.radius);
    radius = block.is_radius_incremental ? radius + read : read;
  }
  if (block.angle.is_programmed()) {
    const double read = run.number(block.angle);
    angle = block.is_angle_incremental ? angle + read : read;
  }
  polar = {true, true, radius, angle};
  run.ledger.take_all();
  set_in_plane(state, target, pole_in_plane(state) + radius * unit_vector(angle));
  for (const Coordinate& word : block.words()) {
    double value = run.coordinate(word.axis, word.value);
    if (word.is_incremental) value += state.nominal_of(word.axis);
    target.set(word.axis, value);
  }
  return true;
}

bool read_cycle_feed(Run& run, const Value& word, double& feed) {
  feed = run.number(word);
  const bool is_inch = run.state.units == Units::Inch;
  const double fastest = run.options.is_itnc ? (is_inch ? kFastestItncInch : kFastestLater)
                         : is_inch           ? kFastestInch
                                             : kFastest;
  if (!(feed >= 0 && feed <= fastest)) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("F{} is not 0 to {}", feed, fastest));
  }
  if (is_inch) feed *= Length::kMillimetersPerInch / kTenthsPerInch;
  return true;
}

bool read_feed(Run& run, const Block& block) {
  if (!block.feed.is_programmed()) return true;
  double feed = 0;
  if (!read_cycle_feed(run, block.feed, feed)) return false;
  run.state.feed = feed;
  run.state.rotary_feed = run.number(block.feed);
  return true;
}

bool pace_of(Run& run, const Block& block, Pace& pace) {
  pace = {block.is_rapid, run.state.feed, run.state.rotary_feed};
  if (block.is_rapid || run.state.feed > 0) [[likely]]
    return true;
  return run.fail(ErrorCode::FeedRateMissing, "no F above 0 before this move");
}

PlaneMove plane_move(const State& state, const Target& target) {
  const PlaneAxes axes = axes_of(state.plane);
  PlaneMove move;
  const AxisMask both = static_cast<AxisMask>(bit(axes.first) | bit(axes.second));
  move.has_any = (target.named & both) != 0;
  move.has_both = (target.named & both) == both;
  move.has_third = (target.named & ~both) != 0;
  move.from = in_plane(state, here(state));
  move.to = in_plane(state, target);
  move.has_travel = !(move.from == move.to);
  return move;
}

bool check_arc_start(Run& run) {
  const State& state = run.state;
  if (!state.is_beside) [[likely]]
    return true;
  const PlaneAxes axes = axes_of(state.plane);
  for (const Axis axis : {axes.first, axes.second}) {
    const double by = state.beside[index(axis)];
    if (by == 0) continue;
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    fmt::format("R+ or R- left the tool {} beside the start of the arc along {}: "
                                "position {} before it",
                                shown_length(Length::mm(std::fabs(by)), state.units), letter(axis),
                                letter(axis)));
  }
  return true;
}

bool check_circle_plane(Run& run) {
  const State& state = run.state;
  if (!state.transformation.is_special || state.transformation.keeps_circles(state.plane)) {
    return true;
  }
  const PlaneAxes axes = axes_of(state.plane);
  return run.fail(ErrorCode::PlaneWronglyDefined,
                  fmt::format("rotation or scaling of another plane tilts a circle of {} and {} "
                              "out of the main planes",
                              letter(axes.first), letter(axes.second)));
}

void set_in_plane(const State& state, Target& target, PlaneVector to) {
  const PlaneAxes axes = axes_of(state.plane);
  target.set(axes.first, to.first);
  target.set(axes.second, to.second);
}

void name_plane(const State& state, Target& target) {
  const PlaneAxes axes = axes_of(state.plane);
  target.set(axes.first, target.at[index(axes.first)]);
  target.set(axes.second, target.at[index(axes.second)]);
}

bool names_plane(const State& state, const Target& target) {
  const PlaneAxes axes = axes_of(state.plane);
  return (target.named & bit(axes.first)) != 0 && (target.named & bit(axes.second)) != 0;
}

PlaneVector pole_in_plane(const State& state) {
  const PlaneAxes axes = axes_of(state.plane);
  return {state.pole[index(axes.first)], state.pole[index(axes.second)]};
}

PlaneVector unit_vector(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0) return {1, 0};
  if (turn == 90) return {0, 1};
  if (turn == -90) return {0, -1};
  if (std::fabs(turn) == 180) return {-1, 0};
  const double radians = turn * (Angle::kPi / 180);
  return {std::cos(radians), std::sin(radians)};
}

PlaneVector end_direction(const LastMove& last) {
  PlaneVector along = last.to - last.from;
  if (last.is_arc) {
    const PlaneVector out = last.to - last.center;
    along = last.turn == Turn::Counterclockwise ? left_of(out) : -left_of(out);
  }
  const double size = length(along);
  return size > 0 ? (1 / size) * along : PlaneVector{};
}

}  // namespace dripline::interpreter::tnc155
