#pragma once

#include <cstdint>

#include "clients/tools/post/grid.hpp"

namespace dripline::post {

/// An arc between two points of the grid, with its center as an increment from its start in counts
/// of the center's words.
struct FittedArc {
  std::int64_t first = 0, second = 0;
  double sweep = 0;          ///< degrees, between the rounded ends
  double deviation = 0;      ///< mm from the arc that was asked for, anywhere along it
  double radius_error = 0;   ///< mm: of the radii at both ends
  bool is_possible = false;  ///< it has a radius, and the control takes it
};

/// The center nearest to the arc's for which the whole arc is within `tolerance`; where there is
/// none, the best one. Both ends are rounded by themselves, so the center may have to move with
/// them. Pure: the same for the same arguments.
FittedArc fit_arc(const Grid& grid, const interpreter::Position& from, const interpreter::Arc& arc,
                  double tolerance);

/// The largest distance of the arc from the straight line between its ends, each point to the point
/// at the same fraction of the sweep.
double distance_from_chord(const interpreter::Position& from, const interpreter::Arc& arc);

/// The arc's point after `part` of its sweep; the axes outside of the plane move evenly with the
/// angle.
interpreter::Position point_of(const interpreter::Position& from, const interpreter::Arc& arc,
                               double part);

}  // namespace dripline::post
