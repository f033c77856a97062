#include "clients/tools/statistics/normality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clients/tools/statistics/distributions.hpp"
#include "clients/tools/statistics/summary.hpp"

namespace dripline::statistics {
namespace {

/// D'Agostino and Stephens (1986), table 4.9: four pieces, each an exponential of a parabola.
double p_value_of(double a) {
  const auto parabola = [a](double constant, double linear, double square) {
    return std::exp(constant + linear * a + square * a * a);
  };
  // The parabola has its lowest point far out and rises again; from 10 the chance is below 1e-20.
  constexpr double kFar = 10;
  if (a >= kFar) return 0;
  if (a >= 0.6) return std::clamp(parabola(1.2937, -5.709, 0.0186), 0.0, 1.0);
  if (a >= 0.34) return parabola(0.9177, -4.279, -1.38);
  if (a >= 0.2) return 1 - parabola(-8.318, 42.796, -59.938);
  return 1 - parabola(-13.436, 101.14, -223.73);
}

}  // namespace

Result<AndersonDarling> anderson_darling(std::span<const double> values) {
  if (values.size() < kMinNormalityValues) {
    return fail(Errc::LimitExceeded, "a test for normality of {} values, it needs {}",
                values.size(), kMinNormalityValues);
  }
  if (auto good = check_values(values); !good) return fail(good.error());
  const Summary summary = summarize(values);
  if (!(summary.standard_deviation > 0)) {
    return fail(Errc::Unsupported, "all {} values are equal", summary.count);
  }
  std::vector<double> z(values.begin(), values.end());
  for (double& value : z) value = (value - summary.mean) / summary.standard_deviation;
  std::ranges::sort(z);
  const auto n = static_cast<double>(z.size());
  constexpr double kLeastChance = std::numeric_limits<double>::min();  // has a logarithm
  CompensatedSum sum;
  for (std::size_t i = 0; i < z.size(); ++i) {
    // The upper tail of the mirrored value: 1 - F would lose all digits far out.
    const double below = std::max(normal_cumulative(z[i]), kLeastChance);
    const double above = std::max(normal_cumulative(-z[z.size() - 1 - i]), kLeastChance);
    sum.add((2 * static_cast<double>(i) + 1) * (std::log(below) + std::log(above)));
  }
  AndersonDarling test;
  test.count = z.size();
  test.statistic = -n - sum.value() / n;
  test.adjusted = test.statistic * (1 + 0.75 / n + 2.25 / (n * n));
  test.p_value = p_value_of(test.adjusted);
  return test;
}

}  // namespace dripline::statistics
