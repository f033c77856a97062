#include "clients/tools/graphics/height_field.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::graphics {
namespace {

/// Cells with centers in [low, high], counted from `origin`; `end` is one after the last.
struct CellRange {
  std::size_t begin = 0, end = 0;
};
CellRange cells_between(double low, double high, double origin, double cell, std::size_t count) {
  const double first = std::ceil((low - origin) / cell - 0.5);
  const double last = std::floor((high - origin) / cell - 0.5);
  const double most = static_cast<double>(count);
  const double begin = std::clamp(first, 0.0, most);
  return {static_cast<std::size_t>(begin),
          static_cast<std::size_t>(std::clamp(last + 1, begin, most))};
}

/// A straight cut, parametrized from 0 to 1.
class Cut {
 public:
  Cut(const FramePoint& from, const FramePoint& to, double radius)
      : from_(from),
        along_u_(to.u - from.u),
        along_v_(to.v - from.v),
        along_w_(to.w - from.w),
        square_(along_u_ * along_u_ + along_v_ * along_v_),
        radius_square_(radius * radius) {}

  /// The lowest height of the cutter's end while it covers the point; false where it never does.
  bool reaches(double u, double v, double& height) const {
    const double du = u - from_.u, dv = v - from_.v;
    if (square_ == 0) {
      height = from_.w + std::min(along_w_, 0.0);
      return du * du + dv * dv <= radius_square_;
    }
    const double middle = (du * along_u_ + dv * along_v_) / square_;
    const double aside = du * du + dv * dv - middle * middle * square_;
    if (aside > radius_square_) return false;
    const double half = std::sqrt((radius_square_ - aside) / square_);
    const double first = std::max(0.0, middle - half);
    const double last = std::min(1.0, middle + half);
    if (first > last) return false;
    height = from_.w + along_w_ * (along_w_ < 0 ? last : first);
    return true;
  }

 private:
  FramePoint from_;
  double along_u_, along_v_, along_w_;
  double square_, radius_square_;
};

}  // namespace

HeightField::HeightField(const Cuboid& extent, double cell, std::size_t columns, std::size_t rows)
    : extent_(extent),
      cell_(cell),
      columns_(columns),
      rows_(rows),
      heights_(columns * rows, static_cast<float>(extent.high.w)) {}

Result<HeightField> HeightField::make(const Cuboid& detail, std::size_t cells_along) {
  const double longer = std::max(detail.width(), detail.depth());
  if (!(detail.width() > 0) || !(detail.depth() > 0) || !(detail.height() > 0)) {
    return fail(Errc::LimitExceeded, "a blank of {:g} x {:g} x {:g} mm has no volume",
                detail.width(), detail.depth(), detail.height());
  }
  if (cells_along == 0 || cells_along > kMaxCells) {
    return fail(Errc::LimitExceeded, "{} cells along a side: expected 1 to {}", cells_along,
                kMaxCells);
  }
  const double cell = longer / static_cast<double>(cells_along);
  const auto count = [cell](double side) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(side / cell)));
  };
  const std::size_t columns = count(detail.width()), rows = count(detail.depth());
  if (columns > kMaxCells / rows) {
    return fail(Errc::LimitExceeded, "{} x {} cells are more than {}", columns, rows, kMaxCells);
  }
  return HeightField(detail, cell, columns, rows);
}

void HeightField::cut(const FramePoint& from, const FramePoint& to, double radius) {
  if (std::min(from.w, to.w) >= extent_.high.w || radius <= 0) return;
  const auto across = [&](double a, double b, double origin, std::size_t count) {
    return cells_between(std::min(a, b) - radius, std::max(a, b) + radius, origin, cell_, count);
  };
  const CellRange rows = across(from.v, to.v, extent_.low.v, rows_);
  const CellRange columns = across(from.u, to.u, extent_.low.u, columns_);
  const Cut cut(from, to, radius);
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    const double v = extent_.low.v + (static_cast<double>(row) + 0.5) * cell_;
    float* heights = heights_.data() + row * columns_;
    for (std::size_t column = columns.begin; column < columns.end; ++column) {
      const double u = extent_.low.u + (static_cast<double>(column) + 0.5) * cell_;
      double height = 0;
      if (!cut.reaches(u, v, height)) continue;
      const auto rest = static_cast<float>(std::max(height, extent_.low.w));
      heights[column] = std::min(heights[column], rest);
    }
  }
}

double HeightField::removed_volume() const {
  double depth = 0;
  for (const float height : heights_) depth += extent_.high.w - static_cast<double>(height);
  return depth * cell_ * cell_;
}

}  // namespace dripline::graphics
