#include "clients/tools/post/arc_fit.hpp"

#include <algorithm>
#include <cmath>

#include "clients/tools/comparison/action.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::post {
namespace {

using comparison::Action;
using interpreter::Arc;
using interpreter::axes_of;
using interpreter::Axis;
using interpreter::PlaneVector;
using interpreter::Position;

constexpr double kFull = 2 * Angle::kPi;

Position on_grid(const Grid& grid, Position position) {
  for (const Axis axis : interpreter::kAllAxes)
    position.set_raw(axis, grid.machine(axis, grid.counts(axis, position.raw(axis))));
  return position;
}

Action action_of(const Position& from, const Position& to, const Arc& arc, PlaneVector center) {
  Action action;
  action.kind = comparison::ActionKind::Arc;
  action.has_arc = true;
  action.from = from;
  action.to = to;
  action.plane = arc.plane;
  action.turn = arc.turn;
  action.center = {center.first, center.second};
  return action;
}

/// As every control computes it: equal ends are a full circle.
double sweep_between(PlaneVector start, PlaneVector end, interpreter::Turn turn) {
  if (start == end) return kFull;
  double sweep = turn_between(start, end);
  if (turn == interpreter::Turn::Clockwise) sweep = -sweep;
  return sweep <= 0 ? sweep + kFull : sweep;
}

}  // namespace

FittedArc fit_arc(const Grid& grid, const Position& from, const Arc& arc, double tolerance) {
  const auto axes = axes_of(arc.plane);
  const Position start = on_grid(grid, from), end = on_grid(grid, arc.to);
  const PlaneVector begin = in_plane(start, axes), stop = in_plane(end, axes);
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  Action wanted = action_of(from, arc.to, arc, center);
  wanted.sweep = arc.sweep.radians();
  const double step = grid.center_step();
  const auto first = std::llround((center.first - begin.first) / step);
  const auto second = std::llround((center.second - begin.second) / step);
  FittedArc best;
  best.deviation = best.radius_error = HUGE_VAL;
  const auto try_center = [&](std::int64_t i, std::int64_t j) {
    const PlaneVector at{begin.first + static_cast<double>(i) * step,
                         begin.second + static_cast<double>(j) * step};
    if (at == begin || at == stop) return;
    Action fitted = action_of(start, end, arc, at);
    fitted.sweep = sweep_between(begin - at, stop - at, arc.turn);
    const double error = std::fabs(length(begin - at) - length(stop - at));
    const double deviation = path_distance(wanted, fitted);
    const bool is_possible =
        error <= grid.target().max_radius_error * (1 - 1e-9) && std::isfinite(deviation);
    if (best.is_possible && !is_possible) return;
    const bool is_better = is_possible != best.is_possible || deviation < best.deviation;
    if (is_better)
      best = {i, j, Angle::radians(fitted.sweep).degrees(), deviation, error, is_possible};
  };
  const auto is_good = [&] { return best.is_possible && best.deviation <= tolerance * (1 - 1e-9); };
  try_center(first, second);
  for (std::int64_t ring = 1; ring <= 2 && !is_good(); ++ring) {
    for (std::int64_t i = -ring; i <= ring; ++i) {
      for (std::int64_t j = -ring; j <= ring; ++j) {
        if (std::max(std::abs(i), std::abs(j)) == ring) try_center(first + i, second + j);
      }
    }
  }
  return best;
}

Position point_of(const Position& from, const Arc& arc, double part) {
  const auto axes = axes_of(arc.plane);
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  const PlaneVector start = in_plane(from, axes) - center, end = in_plane(arc.to, axes) - center;
  const double sense = arc.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
  const double angle = std::atan2(start.second, start.first) + sense * arc.sweep.radians() * part;
  const double radius = length(start) + (length(end) - length(start)) * part;
  Position point = arc.to;
  for (const Axis axis : interpreter::kAllAxes) {
    if (!arc.to.has(axis)) continue;
    point.set_raw(axis, from.raw(axis) + (arc.to.raw(axis) - from.raw(axis)) * part);
  }
  set_in_plane(point, axes,
               center + PlaneVector{radius * std::cos(angle), radius * std::sin(angle)});
  return point;
}

double distance_from_chord(const Position& from, const Arc& arc) {
  constexpr int kLooks = 32;
  double furthest = 0;
  for (int i = 1; i < kLooks; ++i) {
    const double part = static_cast<double>(i) / kLooks;
    const Position on_arc = point_of(from, arc, part);
    double squares = 0;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
      const double on_line = from.raw(axis) + (arc.to.raw(axis) - from.raw(axis)) * part;
      squares += (on_arc.raw(axis) - on_line) * (on_arc.raw(axis) - on_line);
    }
    furthest = std::max(furthest, std::sqrt(squares));
  }
  return furthest;
}

}  // namespace dripline::post
