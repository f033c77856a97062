#include "gateway/interpreter/dialects/tnc155/execution/travel_limits.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// A limit may be reached, with the rounding of a rotated coordinate.
constexpr double kLimitNoise = 1e-9;

bool has_mark(const Position& position) {
  return std::any_of(kAllAxes.begin(), kAllAxes.end(),
                     [&](Axis axis) { return position.has(axis); });
}

}  // namespace

TravelLimits::TravelLimits(EventSink& out, const Position& low, const Position& high)
    : EventGate(out), low_(low), high_(high), has_any_(has_mark(low) || has_mark(high)) {}

void TravelLimits::check(const Origin& origin, Axis axis, double value) {
  if (reached_) return;
  const bool is_low = low_.has(axis) && value < low_.raw(axis) - kLimitNoise;
  const bool is_high = high_.has(axis) && value > high_.raw(axis) + kLimitNoise;
  if (is_low || is_high) reached_ = LimitReached{axis, is_high, origin};
}

void TravelLimits::check_line(const Origin& origin, const Position& from, const Position& to) {
  for (const Axis axis : kAllAxes) {
    if (to.raw(axis) != from.raw(axis)) check(origin, axis, to.raw(axis));
  }
}

/// Checks the end of an arc and its extreme points along each axis of its plane.
void TravelLimits::check_arc(const Arc& arc, const Position& from) {
  const PlaneAxes axes = axes_of(arc.plane);
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  const PlaneVector out = in_plane(from, axes) - center;
  const double radius = length(out);
  const double side = arc.turn == Turn::Counterclockwise ? 1 : -1;
  for (const double sign : {1.0, -1.0}) {
    for (const bool is_first : {true, false}) {
      const PlaneVector extreme = is_first ? PlaneVector{sign, 0} : PlaneVector{0, sign};
      double travel = side * turn_between(out, extreme);
      if (travel < 0) travel += 2 * Angle::kPi;
      if (travel > arc.sweep.radians()) continue;
      const double middle = is_first ? center.first : center.second;
      check(arc.origin, is_first ? axes.first : axes.second, middle + sign * radius);
    }
  }
  check_line(arc.origin, from, arc.to);
}

template <class Event>
void TravelLimits::follow(void (EventSink::*deliver)(const Event&), const Event& event,
                          const Position& to) {
  if (reached_) return;
  at_ = to;
  (out().*deliver)(event);
}

void TravelLimits::on_rapid(const Rapid& event) {
  check_line(event.origin, at_, event.to);
  follow(&EventSink::on_rapid, event, event.to);
}
void TravelLimits::on_line(const Line& event) {
  check_line(event.origin, at_, event.to);
  follow(&EventSink::on_line, event, event.to);
}
void TravelLimits::on_arc(const Arc& event) {
  check_arc(event, at_);
  follow(&EventSink::on_arc, event, event.to);
}
/// A probe ends at its contact, which is not known before; the event states the position reached.
void TravelLimits::on_probe(const Probe& event) {
  follow(&EventSink::on_probe, event, event.result ? event.result->at : at_);
}

}  // namespace dripline::interpreter::tnc155
