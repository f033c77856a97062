#include "clients/tools/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>

#include "clients/tools/statistics/summary.hpp"

namespace dripline::statistics {
namespace {

double usual_width(std::span<const double> values, const Summary& summary) {
  std::vector<double> ordered(values.begin(), values.end());
  std::ranges::sort(ordered);
  const double spread = percentile(ordered, 0.75) - percentile(ordered, 0.25);
  const auto n = static_cast<double>(values.size());
  double width = 2 * spread / std::cbrt(n);
  if (!(width > 0)) width = summary.range() / (1 + std::log2(n));  // half of all values are equal
  if (!(width > 0)) width = std::max(std::abs(summary.mean) * 1e-3, 1e-6);
  // Narrower cells than this would have edges that a double cannot tell apart.
  const double magnitude = std::max(std::abs(summary.minimum), std::abs(summary.maximum));
  constexpr double kLeastRelative = 1e-12, kLeastWidth = 1e-30;
  return round_step(
      std::max({width, summary.range() / 100, magnitude * kLeastRelative, kLeastWidth}));
}

}  // namespace

double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  constexpr double kSlack = 1 + 1e-9;  // 0.2 / 0.1 may be a little more than 2
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (step <= factor * power * kSlack) return factor * power;
  }
  return 10 * power;
}

Result<Histogram> make_histogram(std::span<const double> values, std::optional<double> width) {
  if (values.empty()) return fail(Errc::LimitExceeded, "a histogram of no values");
  if (auto good = check_values(values); !good) return fail(good.error());
  const Summary summary = summarize(values);
  Histogram histogram;
  histogram.width = width.value_or(0) > 0 ? *width : usual_width(values, summary);
  const double first = std::floor(summary.minimum / histogram.width);
  const double cells = std::floor(summary.maximum / histogram.width) - first + 1;
  if (!(cells <= static_cast<double>(kMaxCells))) {
    return fail(Errc::LimitExceeded, "a histogram of {} cells, at most {}", cells, kMaxCells);
  }
  histogram.origin = first * histogram.width;
  histogram.counts.resize(static_cast<std::size_t>(cells));
  histogram.total = values.size();
  for (const double value : values) {
    const double cell = std::floor(value / histogram.width) - first;
    ++histogram.counts[static_cast<std::size_t>(std::clamp(cell, 0.0, cells - 1))];
  }
  return histogram;
}

}  // namespace dripline::statistics
