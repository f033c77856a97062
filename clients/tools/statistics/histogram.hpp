#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::statistics {

/// Values counted in cells of one width; a value on an edge is in the cell above it, the largest in
/// the last.
struct Histogram {
  double origin = 0, width = 0;
  std::vector<std::size_t> counts;
  std::size_t total = 0;
  double edge(std::size_t cell) const { return origin + width * static_cast<double>(cell); }
};

inline constexpr std::size_t kMaxCells = 200;

/// Cell width by Freedman and Diaconis (2 IQR / cube root of n), rounded to 1, 2 or 5 times a power
/// of ten, unless `width` is given. Errors: LimitExceeded (no value, one beyond
/// kMaxMagnitude, more than kMaxCells cells).
Result<Histogram> make_histogram(std::span<const double> values,
                                 std::optional<double> width = std::nullopt);

/// 1, 2 or 5 times a power of ten that is at least `step`; for cells and ticks of axes. `step` > 0.
double round_step(double step);

}  // namespace dripline::statistics
