#include "gateway/interpreter/core/path_feed.hpp"

#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter {
namespace {

Feed scaled(const Feed& feed, double factor) {
  switch (feed.per()) {
    case Feed::Per::Minute:
      return Feed::per_minute(feed.length() * factor);
    case Feed::Per::Revolution:
      return Feed::per_revolution(feed.length() * factor);
    case Feed::Per::Move:
      break;
  }
  return feed;
}

/// The length of a helix in relation to that of its circle.
double helix_factor(const Arc& arc, const Position& from) {
  const PlaneAxes axes = axes_of(arc.plane);
  Position beside = arc.to;
  beside.set_raw(axes.first, from.raw(axes.first));
  beside.set_raw(axes.second, from.raw(axes.second));
  const double height = travel_between(from, beside).linear;
  if (height == 0) return 1;
  const auto radius_at = [&](const Position& point) {
    return std::hypot(point.raw(axes.first) - arc.center_first.mm(),
                      point.raw(axes.second) - arc.center_second.mm());
  };
  const double circle = arc.sweep.radians() * (radius_at(from) + radius_at(arc.to)) / 2;
  return circle > 0 ? std::hypot(circle, height) / circle : 1;
}

}  // namespace

AxisTravel travel_between(const Position& from, const Position& to) {
  double linear = 0;
  double rotary = 0;
  for (const Axis axis : kAllAxes) {
    const double travel = to.raw(axis) - from.raw(axis);
    (is_rotary(axis) ? rotary : linear) += travel * travel;
  }
  return {std::sqrt(linear), std::sqrt(rotary)};
}

Feed feed_of_all_axes(const Feed& feed, const AxisTravel& travel, Length degree) {
  if (travel.rotary == 0) return feed;
  if (travel.linear == 0) return scaled(feed, 1 / degree.mm());
  return scaled(feed, travel.linear / std::hypot(travel.linear, travel.rotary * degree.mm()));
}

Feed feed_along_circle(const Feed& feed, const Arc& arc, const Position& from) {
  return scaled(feed, helix_factor(arc, from));
}

Feed circle_feed_of(const Feed& feed, const Arc& arc, const Position& from) {
  return scaled(feed, 1 / helix_factor(arc, from));
}

}  // namespace dripline::interpreter
