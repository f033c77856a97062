#include "clients/tools/statistics/gauge_study.hpp"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

namespace dripline::statistics {
namespace {

// AIAG, Measurement Systems Analysis, 4th edition, table III-B 5: ten parts, three appraisers,
// three trials.
constexpr double kTrials[3][3][10] = {
    {{0.29, -0.56, 1.34, 0.47, -0.80, 0.02, 0.59, -0.31, 2.26, -1.36},
     {0.41, -0.68, 1.17, 0.50, -0.92, -0.11, 0.75, -0.20, 1.99, -1.25},
     {0.64, -0.58, 1.27, 0.64, -0.84, -0.21, 0.66, -0.17, 2.01, -1.31}},
    {{0.08, -0.47, 1.19, 0.01, -0.56, -0.20, 0.47, -0.63, 1.80, -1.68},
     {0.25, -1.22, 0.94, 1.03, -1.20, 0.22, 0.55, 0.08, 2.12, -1.62},
     {0.07, -0.68, 1.34, 0.20, -1.28, 0.06, 0.83, -0.34, 2.19, -1.50}},
    {{0.04, -1.38, 0.88, 0.14, -1.46, -0.29, 0.02, -0.46, 1.77, -1.49},
     {-0.11, -1.13, 1.09, 0.20, -1.07, -0.67, 0.01, -0.56, 1.45, -1.77},
     {-0.15, -0.96, 0.67, 0.11, -1.45, -0.49, 0.21, -0.49, 1.87, -2.16}}};

GaugeStudy aiag_study() {
  constexpr std::array<std::string_view, 3> kAppraisers{"A", "B", "C"};
  constexpr std::array<std::string_view, 10> kParts{"1", "2", "3", "4", "5",
                                                    "6", "7", "8", "9", "10"};
  std::vector<GaugeReading> readings;
  for (std::size_t trial = 0; trial < 3; ++trial)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t p = 0; p < 10; ++p)
        readings.push_back({kAppraisers[a], kParts[p], kTrials[a][trial][p]});
  return make_gauge_study(readings).value();
}

// Its report, figure III-B 16, from the terms as the manual rounds them: to the printed digits.
TEST(AverageAndRange, AgreesWithTheAiagsReport) {
  const auto result = average_and_range({.appraisers = 3,
                                         .parts = 10,
                                         .trials = 3,
                                         .mean_range = 0.3417,
                                         .appraiser_difference = 0.4446,
                                         .part_range = 3.511},
                                        std::nullopt);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->repeatability.deviation, 0.20188, 0.000005);
  EXPECT_NEAR(result->reproducibility.deviation, 0.22963, 0.000005);
  EXPECT_NEAR(result->gauge.deviation, 0.30575, 0.000005);
  EXPECT_NEAR(result->parts.deviation, 1.10456, 0.000005);
  EXPECT_NEAR(result->total, 1.14610, 0.000005);
  EXPECT_NEAR(result->repeatability.study_percent, 17.62, 0.006);  // 17.614: the manual rounds up
  EXPECT_NEAR(result->reproducibility.study_percent, 20.04, 0.005);
  EXPECT_NEAR(result->gauge.study_percent, 26.68, 0.005);
  EXPECT_NEAR(result->parts.study_percent, 96.38, 0.005);
  EXPECT_EQ(result->distinct_categories, 5);
}

// The same from the readings: the terms are 0.341667, 0.444667 and 3.511111, which the manual
// rounds before it continues; 3.511111 * 0.3146 is 1.10460.
TEST(AverageAndRange, OfTheAiagsReadingsDiffersByTheManualsRounding) {
  const auto result = average_and_range(aiag_study(), std::nullopt);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->repeatability.deviation, 0.341667 * 0.5908, 0.000001);
  EXPECT_NEAR(result->repeatability.deviation, 0.20188, 0.00003);
  EXPECT_NEAR(result->reproducibility.deviation, 0.22963, 0.00004);
  EXPECT_NEAR(result->gauge.deviation, 0.30575, 0.00002);
  EXPECT_NEAR(result->parts.deviation, 3.511111 * 0.3146, 0.000001);
  EXPECT_NEAR(result->parts.deviation, 1.10456, 0.00004);
  EXPECT_NEAR(result->total, 1.14610, 0.00004);
  EXPECT_NEAR(result->repeatability.study_percent, 17.62, 0.009);
  EXPECT_NEAR(result->reproducibility.study_percent, 20.04, 0.006);
  EXPECT_NEAR(result->gauge.study_percent, 26.68, 0.006);
  EXPECT_NEAR(result->parts.study_percent, 96.38, 0.006);
  EXPECT_EQ(result->distinct_categories, 5);
  EXPECT_FALSE(result->tolerance_percent);
}

// Its tables III-B 7 and 8.
TEST(GaugeAnova, AgreesWithTheAiagsTables) {
  const auto result = gauge_anova(aiag_study(), 6.0);
  ASSERT_TRUE(result);
  ASSERT_TRUE(result->table);
  const VarianceTable& table = *result->table;
  EXPECT_NEAR(table.appraisers.squares, 3.1673, 0.00006);
  EXPECT_NEAR(table.parts.squares, 88.3619, 0.00006);
  EXPECT_NEAR(table.interaction.squares, 0.3590, 0.00006);
  EXPECT_NEAR(table.repeatability.squares, 2.7589, 0.00006);
  EXPECT_NEAR(table.total.squares, 94.6471, 0.00006);
  EXPECT_EQ(table.total.degrees, 89);
  EXPECT_NEAR(*table.interaction.f, 0.434, 0.0006);
  EXPECT_FALSE(result->is_interaction_kept);
  EXPECT_NEAR(result->repeatability.deviation, 0.199933, 0.000002);
  EXPECT_NEAR(result->reproducibility.deviation, 0.226838, 0.000002);
  EXPECT_NEAR(result->gauge.deviation, 0.302373, 0.000002);
  EXPECT_NEAR(result->parts.deviation, 1.042327, 0.000002);
  EXPECT_NEAR(result->gauge.study_percent, 27.9, 0.06);
  EXPECT_NEAR(result->parts.study_percent, 96.0, 0.06);
  EXPECT_NEAR(result->gauge.contribution_percent, 7.8, 0.06);
  EXPECT_EQ(result->distinct_categories, 4);
  EXPECT_NEAR(*result->tolerance_percent, 30.2, 0.05);
}

TEST(GaugeAnova, KeepsAnInteractionThatIsThere) {
  std::vector<GaugeReading> readings;
  for (int trial = 0; trial < 3; ++trial) {
    const double noise = 0.01 * (trial - 1);
    readings.push_back({"A", "1", 1 + noise});
    readings.push_back({"A", "2", 2 + noise});
    readings.push_back({"A", "3", 3 + noise});
    readings.push_back({"B", "1", 1.5 + noise});
    readings.push_back({"B", "2", 2 + noise});
    readings.push_back({"B", "3", 2.5 + noise});
  }
  const auto result = gauge_anova(make_gauge_study(readings).value(), std::nullopt);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->is_interaction_kept);
  EXPECT_NEAR(result->repeatability.deviation, 0.01, 1e-9);
  EXPECT_GT(result->reproducibility.deviation, 0.2);
}

TEST(GaugeStudy, RefusesAnIncompleteOne) {
  const std::vector<GaugeReading> one_short{{"A", "1", 1}, {"A", "1", 2}, {"A", "2", 1},
                                            {"A", "2", 2}, {"B", "1", 1}, {"B", "1", 2},
                                            {"B", "2", 1}};
  const auto refused = make_gauge_study(one_short);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "appraiser B part 2: 1 trials, the first has 2");
  EXPECT_FALSE(make_gauge_study({}));
  GaugeStudy same{2, 2, 2, std::vector<double>(8, 1.0)};
  EXPECT_FALSE(average_and_range(same, std::nullopt));
  EXPECT_FALSE(gauge_anova(same, std::nullopt));
  same.values.pop_back();
  EXPECT_FALSE(gauge_anova(same, std::nullopt));
}

}  // namespace
}  // namespace dripline::statistics
