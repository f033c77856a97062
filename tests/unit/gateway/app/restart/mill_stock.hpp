#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

/// A block on a mill's table as a map of heights, X0 to kSize and Y0 to kSize, its top at Z0. The
/// tool is a cylinder with its tip at the place.
class MillStock {
 public:
  static constexpr double kSize = 40, kRadius = 2;

  /// Takes out what the tool passes through.
  void cut(const interpreter::Position& from, const interpreter::Position& to) {
    walk(from, to, [&](double& height, double z) { height = std::min(height, z); });
  }
  /// Deepest in material, along the move.
  double depth(const interpreter::Position& from, const interpreter::Position& to) {
    double deepest = 0;
    walk(from, to, [&](double height, double z) { deepest = std::max(deepest, height - z); });
    return deepest;
  }

 private:
  static constexpr int kCells = 80;
  template <class Visit>
  void walk(const interpreter::Position& from, const interpreter::Position& to, Visit visit) {
    using interpreter::Axis;
    const auto part = [&](Axis axis, double t) {
      return from.raw(axis) + t * (to.raw(axis) - from.raw(axis));
    };
    const double travel =
        std::hypot(part(Axis::X, 1) - part(Axis::X, 0), part(Axis::Y, 1) - part(Axis::Y, 0));
    const int steps = 1 + static_cast<int>(travel / 0.25);
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      under(part(Axis::X, t), part(Axis::Y, t),
            [&](double& height) { visit(height, part(Axis::Z, t)); });
    }
  }
  template <class Visit>
  void under(double x, double y, Visit visit) {
    constexpr double kCell = kSize / kCells;
    const auto cell = [](double at) { return static_cast<int>(std::floor(at / kCell)); };
    for (int i = std::max(0, cell(x - kRadius)); i <= std::min(kCells - 1, cell(x + kRadius));
         ++i) {
      for (int j = std::max(0, cell(y - kRadius)); j <= std::min(kCells - 1, cell(y + kRadius));
           ++j) {
        const bool is_under = std::hypot((i + 0.5) * kCell - x, (j + 0.5) * kCell - y) < kRadius;
        if (is_under) visit(heights_[static_cast<std::size_t>(i * kCells + j)]);
      }
    }
  }

  std::vector<double> heights_ = std::vector<double>(kCells * kCells, 0.0);
};

}  // namespace dripline::gateway
