#include "clients/tools/statistics/chart_constants.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

namespace dripline::statistics {
namespace {

/// As printed in ASTM E2587, ISO 7870-2 and Montgomery, appendix VI.
struct Printed {
  std::size_t size;
  double d2, d3, c4, A2, A3, B3, B4, D3, D4;
};
class Table : public testing::TestWithParam<Printed> {};

TEST_P(Table, AgreesToThePrintedDigits) {
  const Printed& row = GetParam();
  const auto constants = chart_constants(row.size);
  ASSERT_TRUE(constants);
  EXPECT_NEAR(constants->d2, row.d2, 0.00051);
  EXPECT_NEAR(constants->d3, row.d3, 0.00051);
  EXPECT_NEAR(constants->c4, row.c4, 0.000051);
  EXPECT_NEAR(constants->A2, row.A2, 0.00051);
  EXPECT_NEAR(constants->A3, row.A3, 0.00051);
  EXPECT_NEAR(constants->B3, row.B3, 0.00051);
  EXPECT_NEAR(constants->B4, row.B4, 0.00051);
  EXPECT_NEAR(constants->D3, row.D3, 0.00051);
  EXPECT_NEAR(constants->D4, row.D4, 0.00051);
}
INSTANTIATE_TEST_SUITE_P(
    , Table,
    testing::Values(Printed{2, 1.128, 0.853, 0.7979, 1.880, 2.659, 0, 3.267, 0, 3.267},
                    Printed{3, 1.693, 0.888, 0.8862, 1.023, 1.954, 0, 2.568, 0, 2.575},
                    Printed{4, 2.059, 0.880, 0.9213, 0.729, 1.628, 0, 2.266, 0, 2.282},
                    Printed{5, 2.326, 0.864, 0.9400, 0.577, 1.427, 0, 2.089, 0, 2.114},
                    Printed{6, 2.534, 0.848, 0.9515, 0.483, 1.287, 0.030, 1.970, 0, 2.004},
                    Printed{7, 2.704, 0.833, 0.9594, 0.419, 1.182, 0.118, 1.882, 0.076, 1.924},
                    Printed{10, 3.078, 0.797, 0.9727, 0.308, 0.975, 0.284, 1.716, 0.223, 1.777},
                    Printed{15, 3.472, 0.756, 0.9823, 0.223, 0.789, 0.428, 1.572, 0.347, 1.653},
                    Printed{25, 3.931, 0.708, 0.9896, 0.153, 0.606, 0.565, 1.435, 0.459, 1.541}),
    [](const auto& i) { return "n" + std::to_string(i.param.size); });

TEST(ChartConstants, AreExactWhereThereIsAFormula) {
  const auto two = chart_constants(2);
  ASSERT_TRUE(two);
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(two->d2, 2 / std::sqrt(pi), 1e-10);
  EXPECT_NEAR(two->d3, std::sqrt(2 - 4 / pi), 1e-7);
  const auto three = chart_constants(3);
  ASSERT_TRUE(three);
  EXPECT_NEAR(three->d2, 3 / std::sqrt(pi), 1e-10);
}

// AIAG, Measurement Systems Analysis, 4th edition, appendix C: d2* of 1, 2 and 3 ranges of 2 to 10
// values.
TEST(ChartConstants, D2OfFewRangesIsTheTableOfTheAiag) {
  constexpr double kPrinted[3][9] = {
      {1.41421, 1.91155, 2.23887, 2.48124, 2.67253, 2.82981, 2.96288, 3.07794, 3.17905},
      {1.27931, 1.80538, 2.15069, 2.40484, 2.60438, 2.76779, 2.90562, 3.02446, 3.12869},
      {1.23105, 1.76858, 2.12049, 2.37883, 2.58127, 2.74681, 2.88628, 3.00643, 3.11173}};
  for (std::size_t ranges = 1; ranges <= 3; ++ranges) {
    for (std::size_t size = 2; size <= 10; ++size) {
      EXPECT_NEAR(d2_of_few_ranges(size, ranges).value(), kPrinted[ranges - 1][size - 2], 0.000015)
          << size << " " << ranges;
    }
  }
}

// Figure III-B 16 of the same: they are 1 / d2* with four digits.
TEST(ChartConstants, GaugeFactorsAreThoseOfTheAiagsForm) {
  EXPECT_EQ(gauge_factor(GaugeFactor::Trials, 2).value(), 0.8862);
  EXPECT_EQ(gauge_factor(GaugeFactor::Trials, 3).value(), 0.5908);
  EXPECT_EQ(gauge_factor(GaugeFactor::Appraisers, 2).value(), 0.7071);
  EXPECT_EQ(gauge_factor(GaugeFactor::Appraisers, 3).value(), 0.5231);
  EXPECT_EQ(gauge_factor(GaugeFactor::Parts, 10).value(), 0.3146);
  for (std::size_t size = 2; size <= 12; ++size) {
    EXPECT_NEAR(gauge_factor(GaugeFactor::Trials, size).value(), 1 / chart_constants(size)->d2,
                0.00005);
    for (const auto factor : {GaugeFactor::Appraisers, GaugeFactor::Parts}) {
      EXPECT_NEAR(gauge_factor(factor, size).value(), 1 / d2_of_few_ranges(size, 1).value(),
                  0.00005)
          << size;
    }
  }
  EXPECT_FALSE(gauge_factor(GaugeFactor::Parts, 1));
  EXPECT_FALSE(gauge_factor(GaugeFactor::Trials, 101));
}

TEST(ChartConstants, RefusesSizesWithoutAMeaning) {
  EXPECT_FALSE(chart_constants(1));
  EXPECT_FALSE(chart_constants(101));
  EXPECT_FALSE(d2_of_few_ranges(3, 0));
  ASSERT_TRUE(chart_constants(100));
}

}  // namespace
}  // namespace dripline::statistics
