#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/result.hpp"

/// The rest of a bar after turning, as one half of its section along the axis. All lengths are in
/// millimeters; `x` is a radius, counted from the spindle's axis.
namespace dripline::graphics {

struct SectionPoint {
  double z = 0, x = 0;
};

/// A bar, or a tube when `x_low` is above 0; also a window onto one.
struct SectionExtent {
  double z_low = 0, z_high = 0;
  double x_low = 0, x_high = 0;
  double length() const { return z_high - z_low; }
  double height() const { return x_high - x_low; }
};

/// Points of a convex outline, in turning order.
using ConvexOutline = std::vector<SectionPoint>;

/// The section as square cells that hold material or not: undercuts, bores and grooves in faces
/// need no special care. Bounded by kMaxCells; no thread.
class TurnedSection {
 public:
  static constexpr std::size_t kMaxCells = std::size_t{1} << 24;

  /// Cells from the axis outwards; `cells_along` along the longer of length and diameter. Errors:
  /// LimitExceeded (no extent, below the axis, more cells than kMaxCells).
  static Result<TurnedSection> make(const SectionExtent& bar, std::size_t cells_along);

  /// Everything goes whose center lies within the outline.
  void remove(std::span<const SectionPoint> convex);
  /// Pieces of no more than `part` of the material fall off: rings between cuts.
  void drop_crumbs(double part);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double cell() const { return cell_; }
  const SectionExtent& bar() const { return bar_; }
  /// Row 0 lies on the axis, column 0 at `z_low`.
  bool has(std::size_t column, std::size_t row) const { return cells_[column * rows_ + row] != 0; }
  double z_of(std::size_t column) const {
    return bar_.z_low + (static_cast<double>(column) + 0.5) * cell_;
  }
  /// Radii of the material's outer and inner surface; both 0 where there is none.
  double outer(std::size_t column) const;
  double inner(std::size_t column) const;
  /// Cubic millimeters that are left.
  double volume() const;

 private:
  TurnedSection(const SectionExtent& bar, double cell, std::size_t columns, std::size_t rows);
  std::vector<std::uint32_t> piece_around(std::uint32_t seed, std::vector<bool>& seen) const;

  SectionExtent bar_;
  double cell_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> cells_;  ///< column by column
};

/// The convex outline around what `outline` covers when it moves from one place to the other.
ConvexOutline swept(const ConvexOutline& outline, const SectionPoint& from, const SectionPoint& to);

}  // namespace dripline::graphics
