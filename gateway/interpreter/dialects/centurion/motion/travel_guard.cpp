#include "gateway/interpreter/dialects/centurion/motion/travel_guard.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/shown_length.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// A move may end on a limit or on the edge of the zone.
constexpr double kRounding = 1e-6;

double angle_of(double z, double x) {
  return std::atan2(x, z);
}

/// The sweep, in radians, from the arc's start to `angle`: from 0 to below a full circle.
double sweep_to(const Arc& arc, double start, double angle) {
  double sweep = arc.turn == Turn::Counterclockwise ? angle - start : start - angle;
  while (sweep < 0) sweep += 2 * Angle::kPi;
  while (sweep >= 2 * Angle::kPi) sweep -= 2 * Angle::kPi;
  return sweep;
}

struct Outside {
  Axis axis;
  double value, low, high;  ///< machine millimeters, X a radius
};

/// "X diameter -1 in is not in -0.2 to 16"
std::string outside_text(const Outside& found, Units units) {
  const LengthDisplay display{.units = units, .x_is_diameter = true};
  return fmt::format("{} {} is not in {} to {}", shown_axis(found.axis, found.value, display),
                     shown_unit(found.axis, units),
                     shown_axis_number(found.axis, found.low, display),
                     shown_axis_number(found.axis, found.high, display));
}

}  // namespace

std::string TravelGuard::place_text(const Spot& at) const {
  const LengthDisplay display{.units = units_, .x_is_diameter = true};
  return fmt::format("{} {} {}", shown_axis(Axis::X, at.x, display),
                     shown_axis(Axis::Z, at.z, display), shown_unit(Axis::Z, units_));
}

TravelGuard::Spot TravelGuard::spot_of(const Position& position) {
  return {position.linear(Axis::X).mm(), position.linear(Axis::Z).mm()};
}

void TravelGuard::place(const Position& at) {
  at_ = spot_of(at);
}

bool TravelGuard::refuse(ErrorCode code, const Origin& origin, std::string detail) {
  fault_ = TravelFault{code, origin, std::move(detail)};
  return false;
}

bool TravelGuard::is_within_limits(const Origin& origin, const Spot& at) {
  const auto is_outside = [](double value, double low, double high) {
    return low < high && !(value >= low - kRounding && value <= high + kRounding);
  };
  if (is_outside(at.x, limits_.min_x, limits_.max_x)) {
    return refuse(ErrorCode::TravelOfX, origin,
                  outside_text({Axis::X, at.x, limits_.min_x, limits_.max_x}, units_));
  }
  if (is_outside(at.z, limits_.min_z, limits_.max_z)) {
    return refuse(ErrorCode::TravelOfZ, origin,
                  outside_text({Axis::Z, at.z, limits_.min_z, limits_.max_z}, units_));
  }
  return true;
}

bool TravelGuard::is_in_zone(const Spot& at) const {
  return at.x > zone_->min_x + kRounding && at.x < zone_->max_x - kRounding &&
         at.z > zone_->min_z + kRounding && at.z < zone_->max_z - kRounding;
}

/// Clips the straight path at each edge of the zone.
bool TravelGuard::crosses_zone(const Spot& to) const {
  double enters = 0;
  double leaves = 1;
  const auto cut = [&](double from, double distance, double low, double high) {
    low += kRounding;
    high -= kRounding;
    if (low >= high) return false;  // no zone was ever set
    if (distance == 0) return from > low && from < high;
    const double a = (low - from) / distance;
    const double b = (high - from) / distance;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
    return enters < leaves;
  };
  return cut(at_.x, to.x - at_.x, zone_->min_x, zone_->max_x) &&
         cut(at_.z, to.z - at_.z, zone_->min_z, zone_->max_z);
}

bool TravelGuard::arc_crosses_zone(const Arc& arc) const {
  const double z = arc.center_first.mm();
  const double x = arc.center_second.mm();
  const double radius = std::hypot(at_.x - x, at_.z - z);
  const double start = angle_of(at_.z - z, at_.x - x);
  // a little before or after the circle crosses an edge it is inside
  const auto is_inside_at = [&](double angle) {
    if (sweep_to(arc, start, angle) > arc.sweep.radians()) return false;
    return is_in_zone({x + radius * std::sin(angle), z + radius * std::cos(angle)});
  };
  constexpr double kStep = 1e-5;
  for (const double edge : {zone_->min_x, zone_->max_x}) {
    const double height = (edge - x) / radius;
    if (std::fabs(height) > 1) continue;
    for (const double angle : {std::asin(height), Angle::kPi - std::asin(height)}) {
      if (is_inside_at(angle + kStep) || is_inside_at(angle - kStep)) return true;
    }
  }
  for (const double edge : {zone_->min_z, zone_->max_z}) {
    const double width = (edge - z) / radius;
    if (std::fabs(width) > 1) continue;
    for (const double angle : {std::acos(width), -std::acos(width)}) {
      if (is_inside_at(angle + kStep) || is_inside_at(angle - kStep)) return true;
    }
  }
  return is_in_zone(spot_of(arc.to));
}

bool TravelGuard::allows_line(const Origin& origin, const Position& to) {
  if (fault_) return false;
  const Spot end = spot_of(to);
  if (!is_within_limits(origin, end)) return false;
  // a tool inside the zone may leave it
  if (zone_ && !is_in_zone(at_) && crosses_zone(end)) {
    return refuse(ErrorCode::SafeZone, origin, place_text(end));
  }
  at_ = end;
  return true;
}

std::optional<TravelFault> TravelGuard::fault_on_line(const Position& from, const Position& to) {
  place(from);
  (void)allows_line({}, to);
  auto fault = std::exchange(fault_, std::nullopt);
  place(from);
  return fault;
}

bool TravelGuard::allows_arc(const Arc& arc) {
  if (fault_) return false;
  const double z = arc.center_first.mm();
  const double x = arc.center_second.mm();
  const double radius = std::hypot(at_.x - x, at_.z - z);
  const double start = angle_of(at_.z - z, at_.x - x);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const double angle = quadrant * Angle::kPi / 2;
    if (sweep_to(arc, start, angle) > arc.sweep.radians()) continue;
    const Spot extreme{x + radius * std::sin(angle), z + radius * std::cos(angle)};
    if (!is_within_limits(arc.origin, extreme)) return false;
  }
  const Spot end = spot_of(arc.to);
  if (!is_within_limits(arc.origin, end)) return false;
  if (zone_ && !is_in_zone(at_) && arc_crosses_zone(arc)) {
    return refuse(ErrorCode::SafeZone, arc.origin, place_text(end));
  }
  at_ = end;
  return true;
}

Feed TravelGuard::followed(Feed feed, double maximum) const {
  if (maximum <= 0 || feed.per() != Feed::Per::Minute || feed.length().mm() <= maximum) return feed;
  return Feed::per_minute(Length::mm(maximum));
}

/// The path feed at which the first axis is at its maximum; 0 is none.
double TravelGuard::max_on_line(const Position& to) const {
  const Spot end = spot_of(to);
  const double x = std::fabs(end.x - at_.x);
  const double z = std::fabs(end.z - at_.z);
  const double distance = std::hypot(x, z);
  double maximum = 0;
  if (max_.x > 0 && x > 0) maximum = max_.x * distance / x;
  if (max_.z > 0 && z > 0) {
    const double by_z = max_.z * distance / z;
    maximum = maximum > 0 ? std::min(maximum, by_z) : by_z;
  }
  return maximum;
}

double TravelGuard::max_on_arc() const {
  const bool has_both = max_.x > 0 && max_.z > 0;
  return has_both ? std::min(max_.x, max_.z) : max_.x + max_.z;
}

bool TravelGuard::allows(Probe& probe) {
  if (!is_active_) return true;
  const Spot from = at_;
  probe.feed = followed(probe.feed, probe.arc ? max_on_arc() : max_on_line(probe.to));
  const bool is_allowed =
      probe.arc ? allows_arc(arc_of(probe)) : allows_line(probe.origin, probe.to);
  at_ = from;
  return is_allowed;
}

void TravelGuard::on_rapid(const Rapid& event) {
  if (!is_active_) return out().on_rapid(event);
  if (allows_line(event.origin, event.to)) out().on_rapid(event);
}
void TravelGuard::on_line(const Line& event) {
  if (!is_active_) return out().on_line(event);
  Line line = event;
  line.feed = followed(event.feed, max_on_line(event.to));
  if (allows_line(event.origin, event.to)) out().on_line(line);
}
void TravelGuard::on_arc(const Arc& event) {
  if (!is_active_) return out().on_arc(event);
  Arc arc = event;
  arc.feed = followed(event.feed, max_on_arc());
  if (allows_arc(event)) out().on_arc(arc);
}
void TravelGuard::on_thread(const Thread& event) {
  if (!is_active_) return out().on_thread(event);
  const bool is_allowed =
      event.arc ? allows_arc(arc_of(event)) : allows_line(event.origin, event.to);
  if (is_allowed) out().on_thread(event);
}
void TravelGuard::on_probe(const Probe& event) {
  if (is_active_ && fault_) return;
  if (event.result) place(event.result->at);
  out().on_probe(event);
}

}  // namespace dripline::interpreter::centurion
