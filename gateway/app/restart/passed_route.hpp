#pragma once

#include <optional>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

/// A point of a lathe's plane in machine coordinates, millimeters; X as a radius.
struct PlanePlace {
  double x = 0, z = 0;
  friend bool operator==(const PlanePlace&, const PlanePlace&) = default;
};
double distance(PlanePlace a, PlanePlace b);
/// Axes that come to rest, or are brought somewhere by hand, are this near, in millimeters.
inline constexpr double kNearPlace = 0.05;
inline bool is_near(PlanePlace a, PlanePlace b) {
  return distance(a, b) <= kNearPlace;
}

/// A move that the tool has made.
struct PassedMove {
  PlanePlace from, to;
  bool is_rapid = false;
  std::optional<interpreter::PathArc> arc = {};  ///< in the plane of Z and X

  /// At 0 it begins, at 1 it ends.
  PlanePlace at(double part) const;
  /// Where a place within `tolerance` is on it.
  std::optional<double> part_at(PlanePlace place, double tolerance) const;
  /// From one part to another, also backward.
  PassedMove piece(double first, double last) const;
};

/// The shortest path from one place to another over pieces of moves that were made, forward and
/// backward. Both places are on such a move within kNearPlace. Nothing: they are not, or the moves
/// between them are missing. Pure; at most a second for 2048 moves.
std::optional<std::vector<PassedMove>> passed_route(const std::vector<PassedMove>& moves,
                                                    PlanePlace from, PlanePlace to);

}  // namespace dripline::gateway
