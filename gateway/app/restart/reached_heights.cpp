#include "gateway/app/restart/reached_heights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::Position;

namespace {

/// An axis that moves by less does not take in another length (machine::AxisLengths), mm.
constexpr double kNoLengthMove = 0.02;

void raise_to(Position& highest, Axis axis, double value) {
  if (!highest.has(axis) || value > highest.raw(axis)) highest.set_raw(axis, value);
}

/// Whether an arc from that angle comes through `wanted`, all in radians.
bool passes(double from, double turn, double wanted) {
  constexpr double kRevolution = 2 * std::numbers::pi;
  double ahead = std::fmod(turn < 0 ? from - wanted : wanted - from, kRevolution);
  if (ahead < 0) ahead += kRevolution;
  return ahead <= std::fabs(turn);
}

}  // namespace

double along(const machine::ToolLengths& lengths, Axis axis) {
  const auto i = static_cast<std::size_t>(axis);
  return i < lengths.size() ? lengths[i] : 0;
}

void ReachedHeights::begin(const Position& begin_at, const machine::ToolLengths& begin_lengths) {
  *this = ReachedHeights();
  at = begin_at;
  lengths = begin_lengths;
  for (const Axis axis : kAllAxes)
    axes.set_raw(axis, begin_at.raw(axis) + along(begin_lengths, axis));
}

void ReachedHeights::raise(Axis axis, double value, const Lengths& now) {
  const double place = value + along(lengths, axis);
  raise_to(axes, axis, place);
  raise_to(tip, axis, place - along(now.of_tool, axis));
}

/// Where the tip is, by the lengths that the axes have taken in.
Position ReachedHeights::tip_at(const Lengths& now) const {
  Position tip_now;
  for (const Axis axis : kAllAxes)
    tip_now.set_raw(axis, at.raw(axis) + along(lengths, axis) - along(now.of_tool, axis));
  return tip_now;
}

void ReachedHeights::move(const Position& to, const Lengths& now, Kind kind) {
  const Position from = tip_at(now);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto axis = static_cast<Axis>(i);
    if (!to.has(axis)) continue;
    const bool takes_length =
        now.shifts_position || std::fabs(to.raw(axis) - at.raw(axis)) > kNoLengthMove;
    if (takes_length) lengths[i] = now.of_axes[i];
  }
  for (const Axis axis : kAllAxes) {
    if (!to.has(axis)) continue;
    raise(axis, to.raw(axis), now);
    at.set_raw(axis, to.raw(axis));
  }
  Position reached = tip_at(now);
  reached.unmark_all();
  reached.mark_all_of(to);
  clear.move({from, reached, kind});
}

/// An arc across the tool axis may be higher between its ends than at both of them.
void ReachedHeights::move(const Position& to, const interpreter::PathArc& arc, const Lengths& now) {
  const interpreter::PlaneAxes plane = axes_of(arc.plane);
  const interpreter::PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  const interpreter::PlaneVector from = in_plane(at, plane) - center;
  const double radius = std::max(length(from), length(in_plane(to, plane) - center));
  const bool is_clockwise = arc.turn == interpreter::Turn::Clockwise;
  const double turn = is_clockwise ? -arc.sweep.radians() : arc.sweep.radians();
  const double angle = std::atan2(from.second, from.first);
  move(to, now, Kind::Arc);
  if (to.has(plane.first) && passes(angle, turn, 0)) raise(plane.first, center.first + radius, now);
  if (to.has(plane.second) && passes(angle, turn, std::numbers::pi / 2))
    raise(plane.second, center.second + radius, now);
}

std::optional<double> ReachedHeights::highest(Axis axis, const Lengths& tool) const {
  std::optional<double> place;
  if (axes.has(axis)) place = axes.raw(axis);
  if (tip.has(axis)) place = std::max(*place, tip.raw(axis) + along(tool.of_tool, axis));
  if (place) *place -= along(tool.of_axes, axis);
  return place;
}

bool ReachedHeights::is_clear(Axis axis, double height, const Lengths& tool) const {
  return clear.is_clear(axis, height + along(tool.of_axes, axis) - along(tool.of_tool, axis));
}

}  // namespace dripline::gateway
