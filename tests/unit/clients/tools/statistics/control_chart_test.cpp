#include "clients/tools/statistics/control_chart.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <numeric>

namespace dripline::statistics {
namespace {

// NIST/SEMATECH e-Handbook 6.3.2.2: ten batches through a flowmeter.
const std::vector<double> kFlowmeter{49.6, 47.6, 49.9, 51.3, 47.8, 51.2, 52.6, 52.4, 53.6, 52.1};

TEST(Individuals, AgreesWithTheHandbooksFlowmeter) {
  const auto baseline = estimate_baseline(kFlowmeter, ChartKind::Individuals, 1, "ten batches");
  ASSERT_TRUE(baseline);
  const auto chart = make_control_chart(kFlowmeter, *baseline, {});
  ASSERT_TRUE(chart);
  ASSERT_EQ(chart->panels.size(), 2U);
  const Panel& x = chart->panels[0];
  EXPECT_NEAR(x.center, 50.81, 1e-9);
  const double rounded = 1.12838 / 1.128;  // the handbook's d2 has three decimals
  EXPECT_NEAR(x.center + (x.upper[0] - x.center) * rounded, 55.8041, 0.00006);
  EXPECT_NEAR(x.center + (x.lower[0] - x.center) * rounded, 45.8159, 0.00006);
  const Panel& ranges = chart->panels[1];
  EXPECT_NEAR(ranges.center, 1.8778, 0.00005);
  EXPECT_NEAR(ranges.upper[0], 3.267 * 1.8778, 0.001);
  EXPECT_EQ(ranges.first, 1U);
  EXPECT_TRUE(chart->is_in_control());
  EXPECT_EQ(to_text(chart->baseline.origin),
            "limits computed from 10 values of ten batches, by mean moving range / d2");
}

// e-Handbook 6.3.2.4: EWMA_0 50, s 2.0539, lambda 0.3, and the table of the weighted means.
TEST(Ewma, AgreesWithTheHandbooksTable) {
  const std::vector<double> values{52.0, 47.0, 53.0, 49.3, 50.1, 47.0, 51.0, 50.1, 51.2, 50.5,
                                   49.6, 47.6, 49.9, 51.3, 47.8, 51.2, 52.6, 52.4, 53.6, 52.1};
  const std::vector<double> printed{50.60, 49.52, 50.56, 50.18, 50.16, 49.21, 49.75,
                                    49.85, 50.26, 50.33, 50.11, 49.36, 49.52, 50.05,
                                    49.38, 49.92, 50.73, 51.23, 51.94, 51.99};
  const auto chart = make_control_chart(values, fixed_baseline(50, 2.0539, "history").value(),
                                        {.kind = ChartKind::Ewma, .ewma_weight = 0.3});
  ASSERT_TRUE(chart);
  const Panel& panel = chart->panels[0];
  ASSERT_EQ(panel.points.size(), printed.size());
  for (std::size_t i = 0; i < printed.size(); ++i) EXPECT_NEAR(panel.points[i], printed[i], 0.0051);
  EXPECT_NEAR(panel.upper.back(), 52.5884, 0.0005);
  EXPECT_NEAR(panel.lower.back(), 47.4115, 0.0005);
  EXPECT_NEAR(panel.upper.front() - 50, 3 * 0.3 * 2.0539, 1e-9);  // of the first point exactly
  EXPECT_TRUE(chart->is_in_control());
}

// e-Handbook 6.3.2.3: target 325, k 0.3175, h 4.1959.
TEST(Cusum, AgreesWithTheHandbooksTable) {
  const std::vector<double> values{324.925, 324.675, 324.725, 324.350, 325.350, 325.225, 324.125,
                                   324.525, 325.225, 324.600, 324.625, 325.150, 328.325, 327.250,
                                   327.825, 328.500, 326.675, 327.775, 326.875, 328.350};
  const auto chart = make_control_chart(
      values, fixed_baseline(325, 1, "target").value(),
      {.kind = ChartKind::Cusum, .cusum_slack = 0.3175, .cusum_decision = 4.1959});
  ASSERT_TRUE(chart);
  const Panel& panel = chart->panels[0];
  const std::vector<double> above{0, 0, 0,    0,    0.03, 0,     0,     0,     0,     0,
                                  0, 0, 3.01, 4.94, 7.45, 10.63, 11.99, 14.44, 16.00, 19.04};
  ASSERT_EQ(panel.points.size(), above.size());
  for (std::size_t i = 0; i < above.size(); ++i)
    EXPECT_NEAR(panel.points[i], above[i], 0.0051) << i;
  EXPECT_NEAR(panel.lower_points[1], -0.0075, 0.0001);
  ASSERT_FALSE(panel.violations.empty());
  EXPECT_EQ(panel.violations.front().point, 13U);  // group 14, as the handbook marks it
}

// Montgomery, Introduction to Statistical Quality Control, example 6.1 (hard bake): grand
// mean 1.5056, mean range 0.32521.
TEST(MeanRange, AgreesWithMontgomerysHardBake) {
  const double sigma = 0.32521 / 2.326;
  const std::vector<double> values{1.5, 1.6, 1.4, 1.5, 1.55};
  const auto chart =
      make_control_chart(values, fixed_baseline(1.5056, sigma, "Montgomery 6.1").value(),
                         {.kind = ChartKind::MeanRange, .subgroup = 5});
  ASSERT_TRUE(chart);
  EXPECT_NEAR(chart->panels[0].upper[0], 1.69325, 0.0001);
  EXPECT_NEAR(chart->panels[0].lower[0], 1.31795, 0.0001);
  EXPECT_NEAR(chart->panels[1].upper[0], 0.68749, 0.0003);
  EXPECT_EQ(chart->panels[1].lower[0], 0);
}

TEST(MeanDeviation, EstimatesSigmaByC4AndUsesB4) {
  std::vector<double> values;
  for (int group = 0; group < 20; ++group)
    for (const double part : {-1.0, 0.0, 1.0}) values.push_back(10 + part + 0.1 * (group % 3));
  const auto baseline = estimate_baseline(values, ChartKind::MeanDeviation, 3, "");
  ASSERT_TRUE(baseline);
  EXPECT_NEAR(baseline->sigma, 1 / 0.8862, 0.0001);
  const auto chart =
      make_control_chart(values, *baseline, {.kind = ChartKind::MeanDeviation, .subgroup = 3});
  ASSERT_TRUE(chart);
  EXPECT_NEAR(chart->panels[1].center, 1, 1e-9);
  EXPECT_NEAR(chart->panels[1].upper[0], 2.568, 0.0006);
}

TEST(ControlChart, KeepsFixedLimitsWhateverTheValuesAre) {
  std::vector<double> drifting(30);
  std::iota(drifting.begin(), drifting.end(), 0.0);
  const auto baseline = fixed_baseline(0, 1, "set-up of 2 March, Meyer");
  ASSERT_TRUE(baseline);
  const auto chart = make_control_chart(drifting, *baseline, {.rules = RuleSet::Nelson});
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->panels[0].upper[29], 3);
  EXPECT_FALSE(chart->is_in_control());
  EXPECT_EQ(to_text(chart->baseline.origin), "limits fixed: set-up of 2 March, Meyer");
}

TEST(ControlChart, LeavesOutWhatFillsNoSubgroup) {
  const std::vector<double> values{1, 2, 3, 2, 3, 4, 9};
  const auto baseline = estimate_baseline(values, ChartKind::MeanRange, 3, "");
  ASSERT_TRUE(baseline);
  EXPECT_EQ(baseline->origin.values, 6U);
  const auto chart =
      make_control_chart(values, *baseline, {.kind = ChartKind::MeanRange, .subgroup = 3});
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->values, 6U);
  EXPECT_EQ(chart->left_out, 1U);
}

TEST(ControlChart, RefusesWhatItCannotJudge) {
  const std::vector<double> same(10, 4.0);
  EXPECT_FALSE(estimate_baseline(same, ChartKind::Individuals, 1, ""));
  EXPECT_FALSE(estimate_baseline(std::vector<double>{1}, ChartKind::Individuals, 1, ""));
  EXPECT_FALSE(estimate_baseline(kFlowmeter, ChartKind::MeanRange, 1, ""));
  EXPECT_FALSE(estimate_baseline(kFlowmeter, ChartKind::Individuals, 2, ""));
  EXPECT_FALSE(fixed_baseline(0, 0, ""));
  const std::vector<double> bad{1, std::numeric_limits<double>::quiet_NaN()};
  const auto refused = estimate_baseline(bad, ChartKind::Individuals, 1, "");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "value 2 of 2 is nan: -1e+100 to 1e+100 can be computed with");
  const auto baseline = fixed_baseline(0, 1, "").value();
  EXPECT_FALSE(
      make_control_chart(kFlowmeter, baseline, {.kind = ChartKind::Ewma, .ewma_weight = 0}));
  EXPECT_FALSE(parse_chart_kind("xbar"));
  EXPECT_EQ(parse_chart_kind("xbar-s").value(), ChartKind::MeanDeviation);
}

}  // namespace
}  // namespace dripline::statistics
