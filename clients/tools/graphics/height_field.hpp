#pragma once

#include <cstddef>
#include <vector>

#include "protocol/base/result.hpp"

/// Material removal on a screen, as the test graphics of a milling control show it: a cuboid blank
/// and a flat-ended cutter whose axis never tilts. All lengths are in millimeters.
namespace dripline::graphics {

/// A point seen along the tool: `u` and `v` are the work plane's axes, `w` points to the spindle.
struct FramePoint {
  double u = 0, v = 0, w = 0;
};

/// A cuboid with sides parallel to the axes.
struct Cuboid {
  FramePoint low, high;
  double width() const { return high.u - low.u; }
  double depth() const { return high.v - low.v; }
  double height() const { return high.w - low.w; }
};

/// The surface of the part: one height per cell of a grid over the blank. A cutter cuts a cell when
/// its center lies in the cutter's circle; everything above the cutter's end goes. Bounded by
/// kMaxCells; no thread.
class HeightField {
 public:
  static constexpr std::size_t kMaxCells = std::size_t{1} << 24;

  /// The material of `blank` inside of `detail` (the whole blank, or a part to be seen larger),
  /// with `cells_along` cells along the longer side of the work plane. Errors: LimitExceeded (no
  /// extent, more cells than kMaxCells).
  static Result<HeightField> make(const Cuboid& detail, std::size_t cells_along);

  /// The cutter goes straight from one point to the other; both may lie anywhere.
  void cut(const FramePoint& from, const FramePoint& to, double radius);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double cell() const { return cell_; }  ///< side of a cell
  const Cuboid& extent() const { return extent_; }
  /// Never below `extent().low.w`: there the material is cut through.
  double at(std::size_t column, std::size_t row) const { return heights_[row * columns_ + column]; }
  /// Row by row, from low v to high v.
  const std::vector<float>& heights() const { return heights_; }
  /// Cubic millimeters gone from the extent.
  double removed_volume() const;

 private:
  HeightField(const Cuboid& extent, double cell, std::size_t columns, std::size_t rows);

  Cuboid extent_;
  double cell_;
  std::size_t columns_, rows_;
  std::vector<float> heights_;
};

}  // namespace dripline::graphics
