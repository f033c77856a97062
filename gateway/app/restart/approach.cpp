#include "gateway/app/restart/approach.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "gateway/app/restart/restart_plan.hpp"

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::Position;

namespace {

constexpr double kSame = 1e-9;    ///< millimeters or degrees
constexpr double kOnMove = 0.02;  ///< likewise: what a position may be off a path

Position along(Axis axis, double value) {
  Position position;
  position.set_raw(axis, value);
  return position;
}

}  // namespace

/// A feed per revolution needs a spindle that rotates; a feed per move is of that move alone.
Feed Approach::plunge_feed() const {
  const bool is_usable = feed &&
                         (feed->per() == Feed::Per::Minute ||
                          (feed->per() == Feed::Per::Revolution && spindle_turns)) &&
                         feed->length() > Length::mm(0);
  return is_usable ? *feed : Feed::per_minute(Length::mm(kPlungeFeedPerMinute));
}

bool Approach::differs(Axis axis) const {
  return to.has(axis) && std::fabs(to.raw(axis) - from.raw(axis)) > kSame;
}

bool Approach::is_far(Axis axis) const {
  return to.has(axis) && std::fabs(to.raw(axis) - from.raw(axis)) > kSameAxes;
}

/// Where no height is known to be clear. At the place the approach only goes up and down.
std::string Approach::height_fault() const {
  std::string now, place;
  for (const Axis axis : kAllAxes) {
    if (axis == tool_axis || !is_far(axis)) continue;
    now += fmt::format(" {}{:.3f}", interpreter::letter(axis), from.raw(axis));
    place += fmt::format(" {}{:.3f}", interpreter::letter(axis), to.raw(axis));
  }
  const char up = interpreter::letter(tool_axis);
  const std::string down =
      to.has(tool_axis) ? fmt::format(": it moves to {}{:.3f} there", up, to.raw(tool_axis)) : "";
  return fmt::format(
      "the axes are at{}, and no height is known to be clear for a move from there to{}, where the "
      "program continues: it has neither led across in rapid nor retracted above its cuts, and "
      "where "
      "it was fed across it may have cut. Bring the axes to{} by hand or by MDI (machine "
      "coordinates), along {} out of the part first, and restart again{}; or restart at another "
      "block",
      now, place, place, up, down);
}

/// Between the place and the end of the straight move that follows it: a run that is cut off stops
/// there.
bool Approach::is_on_next_move() const {
  if (passed == nullptr || !passed->continues_with()) return false;
  const Position& end = passed->continues_with()->to;
  double part = 0, longest = 0;
  for (const Axis axis : kAllAxes) {
    const double travel = end.has(axis) && to.has(axis) ? end.raw(axis) - to.raw(axis) : 0;
    if (std::fabs(travel) <= longest) continue;
    longest = std::fabs(travel);
    part = (from.raw(axis) - to.raw(axis)) / travel;
  }
  if (longest == 0 || part < 0 || part > 1 + kOnMove / longest) return false;
  return std::ranges::all_of(kAllAxes, [&](Axis axis) {
    if (!to.has(axis)) return true;
    const double travel = end.has(axis) ? end.raw(axis) - to.raw(axis) : 0;
    return std::fabs(to.raw(axis) + part * travel - from.raw(axis)) <= kOnMove;
  });
}

/// With the spindle switched on: through no material but what this move of the program cuts.
bool Approach::add_straight_back(Plan& plan) const {
  if (changes_tool || !is_on_next_move()) return false;
  Position back;
  for (const Axis axis : kAllAxes)
    if (to.has(axis)) back.set_raw(axis, to.raw(axis));
  ApproachMove move{back, {}, {}};
  const auto& next = *passed->continues_with();
  const bool is_per_minute = next.feed && next.feed->per() == Feed::Per::Minute;
  if (!next.is_rapid) move.feed = is_per_minute ? *next.feed : plunge_feed();
  plan.after.push_back(move);
  return true;
}

/// Out of the cut along the tool that is in it. Another one may have another axis.
void Approach::add_retracts(Plan& plan) const {
  const auto add = [&](Axis axis, double height) {
    if (height - from.raw(axis) <= kSame) return;
    plan.before.push_back({along(axis, height), {}});
    ++plan.retracts;
  };
  const bool has_other_axis = spindle_axis && *spindle_axis != tool_axis;
  if (has_other_axis && highest.has(*spindle_axis)) add(*spindle_axis, highest.raw(*spindle_axis));
  if (to.has(tool_axis)) add(tool_axis, plan.clearance);
}

Approach::Plan Approach::plan() const {
  if (is_lathe) return lathe_plan();
  Plan plan;
  const bool has_tool_axis = to.has(tool_axis);
  const double now = from.raw(tool_axis);
  const double target = has_tool_axis ? to.raw(tool_axis) : now;
  plan.clearance = std::max(now, target);
  if (highest.has(tool_axis)) plan.clearance = std::max(plan.clearance, highest.raw(tool_axis));
  Position others;
  bool is_elsewhere = false, is_across = false;
  for (const Axis axis : kAllAxes) {
    if (axis == tool_axis || !to.has(axis)) continue;
    others.set_raw(axis, to.raw(axis));
    is_elsewhere |= differs(axis);
    is_across |= is_far(axis);
  }
  const bool is_there = !is_elsewhere && std::fabs(target - now) <= kSame;
  if (is_there && !changes_tool) return plan;
  add_retracts(plan);
  const bool comes_back = spindle_axis && *spindle_axis != tool_axis && plan.retracts > 0;
  is_elsewhere |= comes_back;
  is_across |= comes_back;
  if (is_across && !is_clear) {
    plan.before.clear();
    plan.retracts = 0;
    if (!add_straight_back(plan)) plan.fault = height_fault();
    return plan;
  }
  if (is_elsewhere) plan.before.push_back({others, {}});
  if (!has_tool_axis || plan.clearance - target <= kSame) return plan;
  if (plan.clearance - target > kPlunge)
    plan.after.push_back({along(tool_axis, target + kPlunge), {}});
  plan.after.push_back({along(tool_axis, target), plunge_feed()});
  return plan;
}

void write_approach(const Approach::Plan& plan, const DeliveredState& state,
                    const interpreter::Origin& origin, interpreter::EventSink& out) {
  const auto move = [&](const ApproachMove& one) {
    if (one.arc) {
      return out.on_arc({origin, one.to, one.arc->center_first, one.arc->center_second,
                         one.arc->plane, one.arc->turn, one.arc->sweep, *one.feed, true});
    }
    if (one.feed) return out.on_line({origin, one.to, *one.feed, true});
    out.on_rapid({origin, one.to, true});
  };
  for (std::size_t i = 0; i < plan.retracts; ++i) move(plan.before[i]);
  if (state.tool) out.on_tool({origin, *state.tool, false, state.tool_offset, state.tool_shape});
  if (state.next_tool) out.on_tool({origin, *state.next_tool, true, {}, {}});
  for (std::size_t i = plan.retracts; i < plan.before.size(); ++i) move(plan.before[i]);
  if (state.spindle.state != interpreter::SpindleState::Off) {
    interpreter::Spindle spindle = state.spindle;
    spindle.origin = origin;
    out.on_spindle(spindle);
  }
  if (state.flood || state.mist) out.on_coolant({origin, state.flood, state.mist});
  for (const ApproachMove& one : plan.after) move(one);
  interpreter::OverrideInhibit inhibit = state.inhibit;
  const bool is_inhibited = inhibit.feed_override || inhibit.spindle_override ||
                            inhibit.single_block ||
                            inhibit.hold != interpreter::FeedHoldInhibit::AtOnce;
  if (!is_inhibited) return;
  inhibit.origin = origin;
  out.on_override_inhibit(inhibit);
}

}  // namespace dripline::gateway
