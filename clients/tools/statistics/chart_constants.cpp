#include "clients/tools/statistics/chart_constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>

#include "clients/tools/statistics/distributions.hpp"

namespace dripline::statistics {
namespace {

/// Beyond 8 sigma nothing of 100 values is left that a double would show. The integrands are smooth
/// and vanish at both ends, where the trapezoidal rule converges faster than any power of the step.
constexpr double kReach = 8;
constexpr int kSteps = 400;
constexpr double kStep = 2 * kReach / kSteps;

struct RangeMoments {
  double mean = 0, deviation = 0;
};

/// With F the normal distribution and n values: E[R] = integral of 1 - F^n - (1 - F)^n, and
/// E[R^2] = 2 * integral over x < y of 1 - F(y)^n - (1 - F(x))^n + (F(y) - F(x))^n.
RangeMoments range_moments(std::size_t size) {
  const auto n = static_cast<double>(size);
  std::array<double, kSteps + 1> below{};
  for (int i = 0; i <= kSteps; ++i) {
    below[static_cast<std::size_t>(i)] = normal_cumulative(-kReach + i * kStep);
  }
  double mean = 0, square = 0;
  for (std::size_t y = 0; y <= kSteps; ++y) {
    const double all_below = std::pow(below[y], n);
    mean += 1 - all_below - std::pow(1 - below[y], n);
    for (std::size_t x = 0; x < y; ++x) {
      square += 1 - all_below - std::pow(1 - below[x], n) + std::pow(below[y] - below[x], n);
    }
    square += (1 - all_below - std::pow(1 - below[y], n)) / 2;  // the end of the inner integral
  }
  mean *= kStep;
  // The inner integrand does not vanish at its upper end. What the rule is off there (Euler,
  // Maclaurin) has the slope n (1 - F)^(n-1) f, whose integral over y is 1 for every n.
  square = 2 * kStep * kStep * (square - 1.0 / 12);
  return {mean, std::sqrt(square - mean * mean)};
}

ChartConstants compute(std::size_t size) {
  const auto n = static_cast<double>(size);
  const RangeMoments range = range_moments(size);
  ChartConstants constants;
  constants.d2 = range.mean;
  constants.d3 = range.deviation;
  constants.c4 = std::sqrt(2 / (n - 1)) * std::exp(std::lgamma(n / 2) - std::lgamma((n - 1) / 2));
  constants.A2 = 3 / (constants.d2 * std::sqrt(n));
  constants.A3 = 3 / (constants.c4 * std::sqrt(n));
  const double deviation_width = 3 * std::sqrt(1 - constants.c4 * constants.c4) / constants.c4;
  constants.B3 = std::max(0.0, 1 - deviation_width);
  constants.B4 = 1 + deviation_width;
  const double range_width = 3 * constants.d3 / constants.d2;
  constants.D3 = std::max(0.0, 1 - range_width);
  constants.D4 = 1 + range_width;
  constants.E2 = 3 / constants.d2;
  return constants;
}

}  // namespace

Result<ChartConstants> chart_constants(std::size_t size) {
  if (size < 2 || size > kMaxSubgroup) {
    return fail(Errc::LimitExceeded, "subgroups of {} values: 2 to {} are possible", size,
                kMaxSubgroup);
  }
  static std::mutex mutex;
  static std::array<std::optional<ChartConstants>, kMaxSubgroup + 1> known;
  const std::scoped_lock lock(mutex);
  if (!known[size]) known[size] = compute(size);
  return *known[size];
}

Result<double> gauge_factor(GaugeFactor factor, std::size_t size) {
  constexpr std::array kTrials{0.8862, 0.5908};
  constexpr std::array kRange{0.7071, 0.5231, 0.4467, 0.4030, 0.3742,
                              0.3534, 0.3375, 0.3249, 0.3146};
  const std::size_t tabulated =
      factor == GaugeFactor::Parts ? kRange.size() : kTrials.size();  // from size 2 on
  if (size >= 2 && size - 2 < tabulated)
    return factor == GaugeFactor::Trials ? kTrials[size - 2] : kRange[size - 2];
  if (factor == GaugeFactor::Trials) {
    const auto constants = chart_constants(size);
    if (!constants) return fail(constants.error());
    return 1 / constants->d2;
  }
  const auto d2 = d2_of_few_ranges(size, 1);
  if (!d2) return d2;
  return 1 / *d2;
}

Result<double> d2_of_few_ranges(std::size_t size, std::size_t ranges) {
  if (ranges == 0) return fail(Errc::LimitExceeded, "a mean of no ranges");
  const auto constants = chart_constants(size);
  if (!constants) return fail(constants.error());
  return std::sqrt(constants->d2 * constants->d2 +
                   constants->d3 * constants->d3 / static_cast<double>(ranges));
}

}  // namespace dripline::statistics
