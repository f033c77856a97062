#include "clients/tools/charts/contour.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

namespace dripline::charts {
namespace {

TEST(Contour, DeviationIsSignedToTheLeftOfTheDirection) {
  const std::vector<ContourPoint> line{{0, 0}, {10, 0}};
  const auto found = deviations(line, std::vector<ContourPoint>{{3, 0.02}, {7, -0.05}, {12, 0}});
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[0].deviation, 0.02, 1e-12);
  EXPECT_NEAR((*found)[0].along, 3, 1e-12);
  EXPECT_NEAR((*found)[1].deviation, -0.05, 1e-12);
  EXPECT_NEAR((*found)[2].deviation, 2, 1e-12);  // past the end: the distance to the end
  EXPECT_NEAR((*found)[0].normal.v, 1, 1e-12);
}

TEST(Contour, TakesTheNearestSegmentOfACircle) {
  std::vector<ContourPoint> circle, measured;
  for (int i = 0; i <= 3600; ++i) {
    const double angle = i * std::acos(-1.0) / 1800;
    circle.push_back(
        {20 * std::cos(angle), 20 * std::sin(angle)});  // counterclockwise: left is inside
    if (i % 100 == 7) measured.push_back({20.03 * std::cos(angle), 20.03 * std::sin(angle)});
  }
  const auto found = deviations(circle, measured);
  ASSERT_TRUE(found);
  for (const auto& point : *found) EXPECT_NEAR(point.deviation, -0.03, 1e-4);
}

TEST(Contour, RefusesWhatIsNone) {
  const std::vector<ContourPoint> line{{0, 0}, {10, 0}}, dot{{1, 1}, {1, 1}};
  EXPECT_FALSE(deviations(line, {}));
  EXPECT_FALSE(deviations(dot, line));
  EXPECT_FALSE(deviations({}, line));
  const std::vector<ContourPoint> bad{{std::numeric_limits<double>::quiet_NaN(), 0}};
  EXPECT_FALSE(deviations(line, bad));
  const std::vector<ContourPoint> many(kMaxContourPoints + 1, {1, 1});
  EXPECT_FALSE(deviations(line, many));
}

}  // namespace
}  // namespace dripline::charts
