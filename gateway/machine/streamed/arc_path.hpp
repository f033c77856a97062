#pragma once

#include <vector>

#include "gateway/machine/streamed/text_rules.hpp"

namespace dripline::machine::streamed {

/// An arc of a program as lines of text describe it. Pure.
struct ArcPath {
  std::size_t first = 0, second = 1;  ///< axes of the plane
  double center_first = 0, center_second = 0;
  double start_radius = 0, end_radius = 0;
  double start = 0;  ///< radians
  double sweep = 0;  ///< radians, counterclockwise positive
  Coordinates from{}, to{};

  double plane_length() const;
  double length() const;       ///< of all axes
  double feed_length() const;  ///< of X, Y and Z, which a feed is for
  /// `part` from 0 to 1 of the path; the axes outside the plane move evenly with the angle.
  Coordinates at(double part) const;

 private:
  /// Of the first `count` axes.
  double length_of_axes(std::size_t count) const;
};

/// The direction is the one that meets the end, as for the simulated machine; the event's decides
/// where both do.
ArcPath arc_path(const Coordinates& from, const Coordinates& to, const interpreter::Arc& arc);

/// The ends of pieces, at least `count`, of at most half a circle: an end point that rounding has
/// moved past the start must not make a whole circle of nothing, or nothing of a whole circle.
std::vector<Coordinates> arcs(const ArcPath& path, double count);
/// The ends of chords that leave the path by at most `deviation` (mm).
std::vector<Coordinates> chords(const ArcPath& path, double deviation);

/// The points of the path where an axis of the plane is farthest out; not its ends.
std::vector<Coordinates> extremes(const ArcPath& path);

}  // namespace dripline::machine::streamed
