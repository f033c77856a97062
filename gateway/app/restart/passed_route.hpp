#pragma once

#include <optional>
#include <vector>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::gateway {

/// Of a lathe, in machine coordinates: places are along Z and X, which is a radius.
inline constexpr interpreter::PlaneAxes kLathePlane = interpreter::axes_of(interpreter::Plane::ZX);

/// Axes that come to rest, or are brought somewhere by hand, are this near, in millimeters.
inline constexpr double kNearPlace = 0.05;
inline bool is_near(interpreter::PlaneVector a, interpreter::PlaneVector b) {
  return length(a - b) <= kNearPlace;
}

/// A move that the tool has made.
struct PassedMove {
  interpreter::PlaneVector from, to;
  bool is_rapid = false;
  std::optional<interpreter::PathArc> arc = {};  ///< in the plane of Z and X

  /// At 0 it begins, at 1 it ends.
  interpreter::PlaneVector at(double part) const;
  /// Where a place within `tolerance` is on it.
  std::optional<double> part_at(interpreter::PlaneVector place, double tolerance) const;
  /// From one part to another, also backward.
  PassedMove piece(double first, double last) const;
};

/// The shortest path from one place to another over pieces of moves that were made, forward and
/// backward. Both places are on such a move within kNearPlace. Nothing: they are not, or the moves
/// between them are missing. Pure; at most a second for 2048 moves.
std::optional<std::vector<PassedMove>> passed_route(const std::vector<PassedMove>& moves,
                                                    interpreter::PlaneVector from,
                                                    interpreter::PlaneVector to);

}  // namespace dripline::gateway
