#include "clients/tools/graphics/turned_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dripline::graphics {
namespace {

/// The range of x where the line z = `at` meets a convex outline; low above high when it does not.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Span span_at(std::span<const SectionPoint> convex, double at) {
  Span span;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const SectionPoint& a = convex[i];
    const SectionPoint& b = convex[(i + 1) % convex.size()];
    if (std::min(a.z, b.z) > at || std::max(a.z, b.z) < at) continue;
    const double part = a.z == b.z ? 0 : (at - a.z) / (b.z - a.z);
    for (const double x : {a.x + (b.x - a.x) * part, a.z == b.z ? b.x : a.x + (b.x - a.x) * part}) {
      span.low = std::min(span.low, x);
      span.high = std::max(span.high, x);
    }
  }
  return span;
}

double cross(const SectionPoint& o, const SectionPoint& a, const SectionPoint& b) {
  return (a.z - o.z) * (b.x - o.x) - (a.x - o.x) * (b.z - o.z);
}

/// The first cell whose center lies at or after `place`, of cells that begin at `from`.
std::size_t first_cell(double place, double from, double cell, std::size_t count) {
  const double index = std::ceil((place - from) / cell - 0.5);
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(count)));
}

/// Turns the points into the outline around them: monotone chain.
ConvexOutline hull_of(ConvexOutline points) {
  std::sort(points.begin(), points.end(), [](const SectionPoint& a, const SectionPoint& b) {
    return a.z != b.z ? a.z < b.z : a.x < b.x;
  });
  ConvexOutline hull(2 * points.size());
  std::size_t size = 0;
  const auto add = [&](const SectionPoint& point, std::size_t floor) {
    while (size >= floor + 2 && cross(hull[size - 2], hull[size - 1], point) <= 0) --size;
    hull[size++] = point;
  };
  for (const SectionPoint& point : points) add(point, 0);
  const std::size_t lower = size - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.resize(size > 1 ? size - 1 : size);
  return hull;
}

}  // namespace

ConvexOutline swept(const ConvexOutline& outline, const SectionPoint& from,
                    const SectionPoint& to) {
  ConvexOutline points;
  points.reserve(2 * outline.size());
  for (const SectionPoint& point : outline) {
    points.push_back({from.z + point.z, from.x + point.x});
    points.push_back({to.z + point.z, to.x + point.x});
  }
  return hull_of(std::move(points));
}

TurnedSection::TurnedSection(const SectionExtent& bar, double cell, std::size_t columns,
                             std::size_t rows)
    : bar_(bar), cell_(cell), columns_(columns), rows_(rows), cells_(columns * rows, 1) {}

Result<TurnedSection> TurnedSection::make(const SectionExtent& bar, std::size_t cells_along) {
  if (!(bar.length() > 0) || !(bar.height() > 0) || bar.x_low < 0 || cells_along == 0 ||
      !std::isfinite(bar.length()) || !std::isfinite(bar.height())) {
    return fail(Errc::LimitExceeded, "a bar of {} mm by a radius from {} to {} mm has no extent",
                bar.length(), bar.x_low, bar.x_high);
  }
  const double cell = std::max(bar.length(), 2 * bar.x_high) / static_cast<double>(cells_along);
  const double columns = std::ceil(bar.length() / cell), rows = std::ceil(bar.x_high / cell);
  if (columns * rows > static_cast<double>(kMaxCells)) {
    return fail(Errc::LimitExceeded, "{} by {} cells, at most {}", columns, rows, kMaxCells);
  }
  TurnedSection section(bar, cell, static_cast<std::size_t>(columns),
                        static_cast<std::size_t>(rows));
  if (bar.x_low > 0) {
    const SectionPoint tube[] = {{bar.z_low, -1},
                                 {bar.z_high + cell, -1},
                                 {bar.z_high + cell, bar.x_low},
                                 {bar.z_low, bar.x_low}};
    section.remove(tube);
  }
  return section;
}

void TurnedSection::remove(std::span<const SectionPoint> convex) {
  if (convex.empty()) return;
  const auto [low, high] =
      std::minmax_element(convex.begin(), convex.end(),
                          [](const SectionPoint& a, const SectionPoint& b) { return a.z < b.z; });
  const std::size_t last = first_cell(high->z, bar_.z_low, cell_, columns_);
  for (std::size_t column = first_cell(low->z, bar_.z_low, cell_, columns_); column < last;
       ++column) {
    const Span span = span_at(convex, z_of(column));
    const std::size_t from = first_cell(span.low, 0, cell_, rows_);
    const std::size_t to = first_cell(span.high, 0, cell_, rows_);
    if (from >= to) continue;
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(column * rows_);
    std::fill(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(to),
              std::uint8_t{0});
  }
}

/// All cells of one piece: its number of cells decides whether it stays.
std::vector<std::uint32_t> TurnedSection::piece_around(std::uint32_t seed,
                                                       std::vector<bool>& seen) const {
  std::vector<std::uint32_t> piece{seed};
  seen[seed] = true;
  const auto visit = [&](std::size_t cell) {
    if (cells_[cell] == 0 || seen[cell]) return;
    seen[cell] = true;
    piece.push_back(static_cast<std::uint32_t>(cell));
  };
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const std::size_t cell = piece[next], row = cell % rows_;
    if (row > 0) visit(cell - 1);
    if (row + 1 < rows_) visit(cell + 1);
    if (cell >= rows_) visit(cell - rows_);
    if (cell + rows_ < cells_.size()) visit(cell + rows_);
  }
  return piece;
}

void TurnedSection::drop_crumbs(double part) {
  const auto material = std::count(cells_.begin(), cells_.end(), std::uint8_t{1});
  const double least = part * static_cast<double>(material);
  std::vector<bool> seen(cells_.size());
  for (std::size_t seed = 0; seed < cells_.size(); ++seed) {
    if (cells_[seed] == 0 || seen[seed]) continue;
    const auto piece = piece_around(static_cast<std::uint32_t>(seed), seen);
    if (static_cast<double>(piece.size()) > least) continue;
    for (const std::uint32_t cell : piece) cells_[cell] = 0;
  }
}

double TurnedSection::outer(std::size_t column) const {
  for (std::size_t row = rows_; row > 0; --row) {
    if (has(column, row - 1)) return static_cast<double>(row) * cell_;
  }
  return 0;
}

double TurnedSection::inner(std::size_t column) const {
  for (std::size_t row = 0; row < rows_; ++row) {
    if (has(column, row)) return static_cast<double>(row) * cell_;
  }
  return 0;
}

double TurnedSection::volume() const {
  double moment = 0;  // radii of all cells, in cells
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    if (cells_[cell] != 0) moment += static_cast<double>(cell % rows_) + 0.5;
  }
  return 2 * std::numbers::pi * moment * cell_ * cell_ * cell_;
}

}  // namespace dripline::graphics
