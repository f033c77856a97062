#pragma once

#include "gateway/interpreter/core/event.hpp"

/// Feeds of controls whose F is the speed along another path than that of an event, which is the
/// path of the linear axes or, where only rotary axes move, their degrees. Pure.
namespace dripline::interpreter {

/// How far a straight move takes the axes.
struct AxisTravel {
  double linear = 0;  ///< millimeters along the path of the linear axes
  double rotary = 0;  ///< degrees, of several axes together
};
AxisTravel travel_between(const Position& from, const Position& to);

/// The event's feed for a move whose F is the speed of all axes together, a degree of the rotary
/// ones as long as `degree`. Inverse time stays.
Feed feed_of_all_axes(const Feed& feed, const AxisTravel& travel, Length degree);

/// The event's feed for a helix from `from` whose F is the speed along its circle. Inverse time
/// stays.
Feed feed_along_circle(const Feed& feed, const Arc& arc, const Position& from);
/// The reverse: F for the event's feed.
Feed circle_feed_of(const Feed& feed, const Arc& arc, const Position& from);

}  // namespace dripline::interpreter
