#include "clients/tools/statistics/capability.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "clients/tools/statistics/distributions.hpp"

namespace dripline::statistics {
namespace {

/// `count` values that are exactly the quantiles of a normal distribution, in an order without a
/// trend.
std::vector<double> normal_values(std::size_t count, double mean, double sigma) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = i * 7919 % count;  // 7919 is prime
    values.push_back(mean + sigma * normal_quantile((static_cast<double>(place) + 0.5) /
                                                    static_cast<double>(count)));
  }
  return values;
}

// NIST/SEMATECH e-Handbook 7.1.6: USL 20, LSL 8, mean 16, s 2: Cp 1.0, Cpk 0.6667.
TEST(Capability, AgreesWithTheHandbooksExample) {
  std::vector<double> values = normal_values(1000, 16, 2);
  const Summary summary = summarize(values);
  for (double& value : values) value = 16 + (value - summary.mean) * 2 / summary.standard_deviation;
  const auto result = capability(values, {8, 20}, {});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->pp->value, 1.0, 1e-9);
  EXPECT_NEAR(result->ppk->value, 0.6667, 0.00005);
  EXPECT_EQ(result->within_by, "mean moving range / d2");
  // 1 - F(2) above, F(-4) below
  EXPECT_NEAR(result->expected_outside, 22750.13 + 31.67, 0.01);
}

// Montgomery, Introduction to Statistical Quality Control, example 8.4: USL 62, LSL 38, n 20,
// s 1.75: 1.57 <= Cp <= 3.01.
TEST(Capability, IntervalOfCpAgreesWithMontgomery) {
  EXPECT_NEAR((62 - 38) / (6 * 1.75), 2.29, 0.005);
  const Interval interval = chi_squared_interval(2.29, 19, 0.95);
  EXPECT_NEAR(interval.low, 1.57, 0.005);
  EXPECT_NEAR(interval.high, 3.01, 0.005);
}

// The approximation of Bissell (1990) and the e-Handbook: Cpk +- z sqrt(1/9n +
// Cpk^2/2(n-1)).
TEST(Capability, IntervalOfCpkIsBissells) {
  const Interval interval = bissell_interval(1.33, 100, 99, 0.95);
  const double width = 1.95996 * std::sqrt(1.0 / 900 + 1.33 * 1.33 / 198);
  EXPECT_NEAR(interval.low, 1.33 - width, 1e-5);
  EXPECT_NEAR(interval.high, 1.33 + width, 1e-5);
}

TEST(Capability, IntervalsHoldTheTruthAsOftenAsTheyClaim) {
  // 400 samples of 30 from a linear congruential sequence; the true Ppk is 1.
  std::uint64_t state = 12345;
  const auto uniform = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (static_cast<double>(state >> 11U) + 0.5) / 9007199254740992.0;
  };
  int held = 0, held_within = 0;
  for (int sample = 0; sample < 400; ++sample) {
    std::vector<double> values(30);
    for (double& value : values) value = normal_quantile(uniform());
    const auto result = capability(values, {-3, 3}, {});
    ASSERT_TRUE(result);
    held += result->pp->interval->low <= 1 && 1 <= result->pp->interval->high ? 1 : 0;
    held_within += result->cp->interval->low <= 1 && 1 <= result->cp->interval->high ? 1 : 0;
  }
  EXPECT_NEAR(held, 380, 18);
  EXPECT_NEAR(held_within, 380, 18);
}

TEST(Capability, DegreesOfFreedomFollowTheEstimator) {
  const auto values = normal_values(100, 0, 1);
  const auto by_moving_range = capability(values, {-3, 3}, {});
  ASSERT_TRUE(by_moving_range);
  EXPECT_NEAR(by_moving_range->degrees_within, 0.605 * 99, 0.1);
  const auto by_range = capability(values, {-3, 3}, {.subgroup = 5});
  ASSERT_TRUE(by_range);
  EXPECT_NEAR(by_range->degrees_within, 0.906 * 80, 0.5);
}

TEST(Capability, OneLimitHasNoCp) {
  const auto result = capability(normal_values(50, 10, 1), {std::nullopt, 13}, {});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->cp);
  EXPECT_FALSE(result->pp);
  ASSERT_TRUE(result->ppk);
  EXPECT_NEAR(result->ppk->value, 1, 0.05);
}

TEST(Capability, PercentilesAreThoseOfTheShape) {
  auto values = normal_values(2001, 1, 0.25);
  for (double& value : values) value = std::exp(value);
  const auto fitted =
      capability(values, {std::nullopt, std::exp(1.75)}, {.shape = Shape::LogNormal});
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(fitted->percentiles.median, std::exp(1), 1e-6);
  EXPECT_NEAR(fitted->percentiles.high, std::exp(1.75), 0.01);
  EXPECT_NEAR(fitted->ppk->value, 1, 0.01);
  EXPECT_FALSE(fitted->ppk->interval);
  EXPECT_FALSE(fitted->cpk);
  const auto counted =
      capability(values, {std::nullopt, std::exp(1.75)}, {.shape = Shape::Empirical});
  ASSERT_TRUE(counted);
  EXPECT_NEAR(counted->ppk->value, 1, 0.06);
  EXPECT_TRUE(counted->is_percentile_reached);
  // As normal values they would look far better below and worse above.
  const auto as_normal = capability(values, {std::nullopt, std::exp(1.75)}, {});
  ASSERT_TRUE(as_normal);
  EXPECT_GT(as_normal->ppk->value, 1.2);
}

TEST(Capability, SaysWhenPercentilesAreTheExtremes) {
  const auto result = capability(normal_values(100, 0, 1), {-3, 3}, {.shape = Shape::Empirical});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->is_percentile_reached);
}

TEST(Capability, Refuses) {
  const auto values = normal_values(20, 0, 1);
  EXPECT_FALSE(capability(values, {}, {}));
  EXPECT_FALSE(capability(values, {3, -3}, {}));
  EXPECT_FALSE(capability(std::vector<double>{1, 2, 3}, {0, 4}, {}));
  EXPECT_FALSE(capability(std::vector<double>(9, 1.0), {0, 4}, {}));
  EXPECT_FALSE(capability(values, {-3, 3}, {.shape = Shape::LogNormal}));
  EXPECT_FALSE(capability(values, {-3, 3}, {.confidence = 1}));
  EXPECT_FALSE(parse_shape("gauss"));
}

TEST(Capability, HasNoInfiniteIndex) {
  std::vector<double> values(200, 1e15);
  values[3] += 0.125;  // the spread is lost beside the mean
  const auto lost = capability(values, {0.0, 2e15}, {});
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().what, "the values about 1e+15 vary too little");
  values[3] = 1e308;
  EXPECT_EQ(capability(values, {0.0, 2e15}, {}).error().what,
            "value 4 of 200 is 1e+308: -1e+100 to 1e+100 can be computed with");
  values[3] = 2e15;
  EXPECT_EQ(capability(values, {0.0, 1e200}, {}).error().what,
            "a limit of 1e+200: -1e+100 to 1e+100 can be computed with");
}

}  // namespace
}  // namespace dripline::statistics
