// The approach of a lathe: back over moves that the tool has made, so through no material.
#include <fmt/format.h>
#include <cmath>

#include "gateway/app/restart/approach.hpp"

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::PlaneVector;
using interpreter::Position;

namespace {

constexpr double kUnmoved = 0.002;  ///< millimeters: of an axis that was not jogged
/// More are no path that an operator can check on a screen.
constexpr std::size_t kMaxApproachMoves = 16;

PlaneVector plane_place(const Position& position) {
  return in_plane(position, kLathePlane);
}

Position plane_position(PlaneVector place) {
  Position position;
  set_in_plane(position, kLathePlane, place);
  return position;
}

/// As the operator keys it in, in millimeters.
std::string plane_text(PlaneVector place) {
  return fmt::format("X{:.3f} Z{:.3f}", 2 * place.second, place.first);
}

}  // namespace

void Approach::add_route(Plan& plan, const std::vector<PassedMove>& route) const {
  for (const PassedMove& move : route) {
    ApproachMove one{plane_position(move.to), {}, {}};
    if (!move.is_rapid || move.arc) one.feed = plunge_feed();
    one.arc = move.arc;
    plan.after.push_back(one);
  }
}

/// Over moves that were made, from a place on them, or straight from where one axis was jogged away
/// from where the run stopped.
bool Approach::add_passed(Plan& plan) const {
  if (passed == nullptr || passed->has_other_tool()) return false;
  const PlaneVector now = plane_place(from), target = plane_place(to);
  auto route = passed_route(passed->moves(), now, target);
  if (!route && stopped_at) {
    PlaneVector stop = plane_place(*stopped_at);
    const bool is_one_axis = std::fabs(now.second - stop.second) <= kUnmoved ||
                             std::fabs(now.first - stop.first) <= kUnmoved;
    if (!is_one_axis) return false;
    if (is_near(stop, target)) {
      stop = target;
      route.emplace();
    } else {
      route = passed_route(passed->moves(), stop, target);
    }
    if (route) route->insert(route->begin(), PassedMove{now, stop});
  }
  if (!route || route->size() > kMaxApproachMoves) return false;
  add_route(plan, *route);
  return true;
}

/// Farther out, in X and in Z, than where the tool was taken up, and so than the whole path of it:
/// a bar and a chuck that are not there are not here.
bool Approach::is_beyond_all() const {
  if (passed == nullptr || !passed->taken_up_at()) return false;
  const PlaneVector out = *passed->taken_up_at(), now = plane_place(from);
  if (is_near(now, out)) return true;
  if (now.second < out.second - kNearPlace || now.first < out.first - kNearPlace) return false;
  for (const PassedMove& move : passed->moves())
    if (move.to.second > out.second + kNearPlace || move.to.first > out.first + kNearPlace)
      return false;
  return true;
}

bool Approach::add_from_outside(Plan& plan) const {
  if (!is_beyond_all()) return false;
  const PlaneVector now = plane_place(from), out = *passed->taken_up_at();
  if (!leads_to_place(out)) return false;
  const auto route = passed_route(passed->moves(), out, plane_place(to));
  for (const Axis axis : {Axis::X, Axis::Z}) {
    const double value = axis == Axis::X ? out.second : out.first;
    if (std::fabs(value - (axis == Axis::X ? now.second : now.first)) <= kUnmoved) continue;
    Position position;
    position.set_raw(axis, value);
    plan.before.push_back({position, {}, {}});
  }
  if (route) add_route(plan, *route);
  return true;
}

/// Along the one axis that is elsewhere, where nothing is known of where it stopped: it was jogged.
bool Approach::add_straight(Plan& plan) const {
  const bool is_x = differs(Axis::X), is_z = differs(Axis::Z);
  const bool is_other_tool = passed != nullptr && passed->has_other_tool();
  const bool is_next_to = is_near(plane_place(from), plane_place(to));
  if (((is_x && is_z) || is_other_tool || stopped_at) && !is_next_to) return false;
  Position position;
  if (is_x) position.set_raw(Axis::X, to.raw(Axis::X));
  if (is_z) position.set_raw(Axis::Z, to.raw(Axis::Z));
  plan.after.push_back({position, plunge_feed(), {}});
  return true;
}

/// Over moves that were made. A thread is none of them.
bool Approach::leads_to_place(PlaneVector place) const {
  const PlaneVector target = plane_place(to);
  if (is_near(place, target)) return true;
  const auto route = passed_route(passed->moves(), place, target);
  return route && route->size() <= kMaxApproachMoves;
}

std::string Approach::lathe_fault(bool are_others_elsewhere) const {
  const bool is_other_tool = passed != nullptr && passed->has_other_tool();
  std::string text = fmt::format(
      "the axes are at {}, and no path from there to {}, where the program continues, is known to "
      "be free{}: bring the tool there by hand or by MDI",
      plane_text(plane_place(from)), plane_text(plane_place(to)),
      is_other_tool ? ", and another tool is in its position" : "");
  if (are_others_elsewhere) text += ", and the other axes too";
  if (passed != nullptr && passed->taken_up_at() && leads_to_place(*passed->taken_up_at())) {
    text += fmt::format(", or to {}, where the program took it up, or farther out in both",
                        plane_text(*passed->taken_up_at()));
  }
  if (stopped_at && !is_other_tool)
    text += fmt::format(", or back to {}, where it stopped", plane_text(plane_place(*stopped_at)));
  return text + ", or restart at another block (machine coordinates, X as a diameter)";
}

Approach::Plan Approach::lathe_plan() const {
  Plan plan;
  Position others;
  for (const Axis axis : kAllAxes) {
    if (axis != Axis::X && axis != Axis::Z && differs(axis)) others.set_raw(axis, to.raw(axis));
  }
  const bool are_others_elsewhere = others != Position();
  const bool is_elsewhere = differs(Axis::X) || differs(Axis::Z);
  if (!is_elsewhere && !are_others_elsewhere) return plan;
  if (are_others_elsewhere) {
    if (is_beyond_all()) plan.before.push_back({others, {}, {}});
    if (plan.before.empty() || (is_elsewhere && !add_from_outside(plan)))
      plan = {.before = {}, .after = {}, .clearance = 0, .fault = lathe_fault(true)};
    return plan;
  }
  if (!add_passed(plan) && !add_from_outside(plan) && !add_straight(plan))
    plan.fault = lathe_fault(false);
  return plan;
}

}  // namespace dripline::gateway
