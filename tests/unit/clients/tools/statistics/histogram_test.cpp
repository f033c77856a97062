#include "clients/tools/statistics/histogram.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>

#include "tests/unit/clients/tools/statistics/strd.hpp"

namespace dripline::statistics {
namespace {

TEST(Histogram, CountsEveryValueOnceInRoundCells) {
  const auto values = strd::michelso();
  const auto histogram = make_histogram(values);
  ASSERT_TRUE(histogram);
  EXPECT_EQ(std::accumulate(histogram->counts.begin(), histogram->counts.end(), std::size_t{0}),
            100U);
  EXPECT_DOUBLE_EQ(histogram->width, 0.05);
  EXPECT_LE(histogram->origin, 299.62);
  EXPECT_GE(histogram->edge(histogram->counts.size()), 300.07);
}

TEST(Histogram, HasOneCellForEqualValues) {
  const auto histogram = make_histogram(std::vector<double>(7, 40.0));
  ASSERT_TRUE(histogram);
  ASSERT_EQ(histogram->counts.size(), 1U);
  EXPECT_EQ(histogram->counts[0], 7U);
}

TEST(Histogram, RefusesTooManyCells) {
  const std::vector<double> values{0, 1000};
  EXPECT_FALSE(make_histogram(values, 0.001));
  EXPECT_FALSE(make_histogram({}));
  EXPECT_FALSE(make_histogram(std::vector<double>{std::numeric_limits<double>::infinity()}));
}

TEST(RoundStep, IsOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_step(0.9), 1);
  EXPECT_DOUBLE_EQ(round_step(0.0013), 0.002);
  EXPECT_DOUBLE_EQ(round_step(2.1), 5);
  EXPECT_DOUBLE_EQ(round_step(6), 10);
  EXPECT_DOUBLE_EQ(round_step(0.2), 0.2);
}

}  // namespace
}  // namespace dripline::statistics
