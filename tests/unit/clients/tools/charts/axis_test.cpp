#include "clients/tools/charts/axis.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

namespace dripline::charts {
namespace {

struct ScaleCase {
  const char* name;
  double low, high, step;
  const char* first;
};
class Scale : public testing::TestWithParam<ScaleCase> {};

TEST_P(Scale, HasTicksOfOneTwoOrFiveThatItsLabelsShowExactly) {
  const Axis axis = make_axis(GetParam().low, GetParam().high, 6);
  EXPECT_DOUBLE_EQ(axis.step, GetParam().step);
  EXPECT_LT(axis.low, GetParam().low);
  EXPECT_GT(axis.high, GetParam().high);
  const auto ticks = axis.ticks();
  ASSERT_GE(ticks.size(), 3U);
  EXPECT_LE(ticks.size(), 8U);
  EXPECT_EQ(axis.label(ticks.front()), GetParam().first);
  for (const double tick : ticks) EXPECT_NEAR(std::stod(axis.label(tick)), tick, axis.step * 1e-6);
}
INSTANTIATE_TEST_SUITE_P(, Scale,
                         testing::Values(ScaleCase{"hundredths", 39.97, 40.03, 0.02, "39.98"},
                                         ScaleCase{"negative", -0.012, 0.007, 0.005, "-0.010"},
                                         ScaleCase{"large", 0, 1200, 500, "0"},
                                         ScaleCase{"tiny", 1e-7, 5e-7, 1e-7, "0.0000001"}),
                         [](const auto& i) { return std::string{i.param.name}; });

TEST(Axis, OfOneValueHasRoomAndOfIndicesHasWholeNumbers) {
  const Axis same = make_axis(40, 40, 5);
  EXPECT_LT(same.low, 40);
  EXPECT_GT(same.high, 40);
  const Axis index = make_index_axis(1, 7, 20);
  EXPECT_EQ(index.step, 1);
  EXPECT_EQ(index.label(index.ticks().front()), "1");
  EXPECT_EQ(index.ticks().size(), 7U);
}

TEST(Plot, PlacesLargeValuesAbove) {
  const Plot plot{{10, 20, 100, 50}, {0, 10, 1, 0}, {0, 5, 1, 0}};
  EXPECT_EQ(plot.place(0, 0).x, 10);
  EXPECT_EQ(plot.place(0, 0).y, 70);
  EXPECT_EQ(plot.place(10, 5).x, 110);
  EXPECT_EQ(plot.place(10, 5).y, 20);
}

}  // namespace
}  // namespace dripline::charts
