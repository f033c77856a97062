#include "clients/tools/statistics/normality.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "clients/tools/statistics/distributions.hpp"
#include "clients/tools/statistics/summary.hpp"
#include "tests/unit/clients/tools/statistics/strd.hpp"

namespace dripline::statistics {
namespace {

/// The definition, n * integral of (Fn - F)^2 / (F (1 - F)) dF, by a fine sum between neighboring
/// values.
double by_definition(std::vector<double> values) {
  const Summary summary = summarize(values);
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  const auto count_below = [&](double z) {
    const double x = summary.mean + z * summary.standard_deviation;
    return static_cast<double>(std::ranges::upper_bound(values, x) - values.begin());
  };
  double sum = 0;
  constexpr double kStep = 1e-4;
  for (double z = -9; z < 9; z += kStep) {
    const double at = z + kStep / 2;
    const double below = normal_cumulative(at), above = normal_cumulative(-at);
    const double difference = count_below(at) / n - below;
    // Far out the empirical function is exactly 0 or 1: the quotient is below / above or its
    // inverse.
    sum += difference * difference / (below * above) * normal_density(at) * kStep;
  }
  return n * sum;
}

TEST(AndersonDarling, IsTheIntegralThatItIsDefinedBy) {
  const auto values = strd::michelso();
  const auto test = anderson_darling(values);
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->statistic, by_definition(values), 2e-4);
  const auto other = strd::mavro();
  EXPECT_NEAR(anderson_darling(other)->statistic, by_definition(other), 2e-4);
}

/// Ordered values whose distribution is stretched from normal until the adjusted statistic is
/// `wanted`.
double p_at(double wanted) {
  double low = 0, high = 3;
  double p = 0;
  for (int step = 0; step < 60; ++step) {
    const double skew = (low + high) / 2;
    std::vector<double> values;
    for (int i = 0; i < 60; ++i) {
      const double z = normal_quantile((i + 0.5) / 60);
      values.push_back(skew == 0 ? z : std::expm1(skew * z) / skew);
    }
    const auto test = anderson_darling(values);
    (test->adjusted > wanted ? high : low) = skew;
    p = test->p_value;
  }
  return p;
}

// Stephens (1974), also NIST/SEMATECH e-Handbook 1.3.5.14 and D'Agostino and Stephens, table 4.7:
// critical values of A*.
TEST(AndersonDarling, CriticalValuesHaveTheirLevels) {
  EXPECT_NEAR(p_at(0.631), 0.10, 0.002);
  EXPECT_NEAR(p_at(0.752), 0.05, 0.001);
  EXPECT_NEAR(p_at(0.873), 0.025, 0.0006);
  EXPECT_NEAR(p_at(1.035), 0.01, 0.0003);
}

TEST(AndersonDarling, RefusesWhatItCannotTest) {
  EXPECT_FALSE(anderson_darling(std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(anderson_darling(std::vector<double>(20, 3.5)));
}

// The formula of the p-value has its lowest point far out and rises again; a tail of 0 has no
// logarithm.
TEST(AndersonDarling, FindsNoNormalityFarOut) {
  std::vector<double> values(4000, 40.0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 1e-6 * static_cast<double>(i % 7);
  values.back() = 4e6;
  const auto test = anderson_darling(values);
  ASSERT_TRUE(test);
  EXPECT_TRUE(std::isfinite(test->statistic));
  EXPECT_GT(test->statistic, 200);
  EXPECT_EQ(test->p_value, 0);
  values.back() = 1e308;
  EXPECT_EQ(anderson_darling(values).error().what,
            "value 4000 of 4000 is 1e+308: -1e+100 to 1e+100 can be computed with");
}

}  // namespace
}  // namespace dripline::statistics
