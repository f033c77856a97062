#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gateway/app/restart/passed_route.hpp"

namespace dripline::gateway {

/// Material of a lathe as columns along Z: from the axis out to a radius, or, bored, from a radius
/// out. A tool that cuts takes all of the column on its side; facing, all in front of it too.
class LatheStock {
 public:
  static constexpr double kWidth = 0.05;
  /// From `front` toward the chuck.
  LatheStock(double radius, double front, double length, bool is_bored)
      : radius_(radius),
        front_(front),
        is_bored_(is_bored),
        surface_(static_cast<std::size_t>(length / kWidth), is_bored ? 0 : radius) {}

  void cut(const PassedMove& move) {
    const bool is_facing = !move.arc && std::fabs(move.from.first - move.to.first) < 1e-9;
    walk(move, [&](interpreter::PlaneVector at) {
      for (std::size_t i = column(at.first + (is_facing ? 100 : kWidth)); i < surface_.size();
           ++i) {
        if (z_of(i) < at.first - kWidth) break;
        surface_[i] =
            is_bored_ ? std::max(surface_[i], at.second) : std::min(surface_[i], at.second);
      }
    });
  }
  /// Deepest in material, along the move.
  double depth_of(const PassedMove& move) const {
    double depth = 0;
    walk(move, [&](interpreter::PlaneVector at) { depth = std::max(depth, depth_at(at)); });
    return depth;
  }
  double depth_at(interpreter::PlaneVector at) const {
    if (at.first > front_ || at.second > radius_) return 0;
    // Beside a wall the columns are too wide.
    double depth = 1000;
    const std::size_t middle = column(at.first);
    for (std::size_t i = middle > 1 ? middle - 2 : 0; i <= middle + 2; ++i) {
      if (i >= surface_.size()) continue;
      depth = std::min(depth, is_bored_ ? at.second - surface_[i] : surface_[i] - at.second);
    }
    return std::max(depth, 0.0);
  }

 private:
  double z_of(std::size_t column) const {
    return front_ - (static_cast<double>(column) + 0.5) * kWidth;
  }
  std::size_t column(double z) const {
    return static_cast<std::size_t>(std::max(0.0, (front_ - z) / kWidth));
  }
  template <class Visit>
  static void walk(const PassedMove& move, Visit visit) {
    const double turn = move.arc ? move.arc->sweep.radians() * 30 : 0;
    const int steps = 1 + static_cast<int>((length(move.to - move.from) + turn) / 0.02);
    for (int i = 0; i <= steps; ++i) visit(move.at(static_cast<double>(i) / steps));
  }

  double radius_, front_;
  bool is_bored_;
  std::vector<double> surface_;
};

}  // namespace dripline::gateway
