#include "gateway/app/restart/clear_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::Position;

namespace {

constexpr double kStill = 0.02;  ///< millimeters; also what takes in another length
constexpr std::array kToolAxes{Axis::X, Axis::Y, Axis::Z};

void lift(Position& highest, Axis axis, double value) {
  if (!highest.has(axis) || value > highest.raw(axis)) highest.set_raw(axis, value);
}
void lower(Position& lowest, Axis axis, double value) {
  if (!lowest.has(axis) || value < lowest.raw(axis)) lowest.set_raw(axis, value);
}

/// U, V and W are parallel to X, Y and Z.
bool is_parallel(Axis axis, Axis other) {
  constexpr auto kFirst = static_cast<int>(Axis::U);
  return axis == other || static_cast<int>(axis) == static_cast<int>(other) - kFirst;
}

bool leads_across(Axis axis, const ClearHeights::Move& move) {
  return std::ranges::any_of(interpreter::kAllAxes, [&](Axis other) {
    return !interpreter::is_rotary(other) && !is_parallel(axis, other) && move.to.has(other) &&
           std::fabs(move.to.raw(other) - move.from.raw(other)) > kStill;
  });
}

}  // namespace

void ClearHeights::move(const Move& move) {
  for (const Axis axis : kToolAxes) move_along(axis, move);
  has_moved_ = true;
}

void ClearHeights::move_along(Axis axis, const Move& move) {
  const bool is_across =
      move.kind == Kind::Arc || leads_across(axis, move);  // a circle ends as it begins
  const double lowered = move.from.raw(axis) - move.to.raw(axis);
  if (!has_moved_ && !is_across && lowered >= kLowered) begun_.set_raw(axis, move.from.raw(axis));
  if (!is_across && std::fabs(lowered) <= kStill) return;
  move.kind == Kind::Rapid ? add_rapid(axis, move, is_across) : add_feed(axis, move, is_across);
}

void ClearHeights::add_rapid(Axis axis, const Move& move, bool is_across) {
  if (is_across) {
    crossed_.mark(axis);
  } else if (move.to.raw(axis) > move.from.raw(axis)) {
    lift(retracted_, axis, move.to.raw(axis));
  }
}

void ClearHeights::add_feed(Axis axis, const Move& move, bool is_across) {
  const auto [low, high] = std::minmax({move.from.raw(axis), move.to.raw(axis)});
  lift(entered_, axis, high);
  lower(deepest_, axis, low);
  if (is_across) lift(cut_, axis, high);
}

bool ClearHeights::is_clear(Axis axis, double highest) const {
  const bool is_above_cuts = !deepest_.has(axis) || highest > deepest_.raw(axis) + kStill;
  if (!is_above_cuts) return false;
  // Beside the part a rapid may be at the depth of the cuts: it shows a height above them alone.
  if (crossed_.has(axis) && (!cut_.has(axis) || highest > cut_.raw(axis) + kStill)) return true;
  // A rapid that ends within a hole clears its chips.
  const bool is_out = !entered_.has(axis) || retracted_.raw(axis) >= entered_.raw(axis) - kStill;
  if (retracted_.has(axis) && is_out) return true;
  return begun_.has(axis) && (!cut_.has(axis) || begun_.raw(axis) >= cut_.raw(axis) - kStill);
}

}  // namespace dripline::gateway
