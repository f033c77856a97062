#include <gtest/gtest.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/compensation/tangents.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr Beside kSides[] = {Beside::Left, Beside::Right};
const PlaneCircle kFirst{{1, -2}, 1.5};
const PlaneCircle kSecond{{7, 3}, 2.5};

double side_of(PlaneVector point) {
  return cross(kSecond.center - kFirst.center, point - kFirst.center);
}
bool is_on(Beside side, PlaneVector point, PlaneVector center) {
  const double turn = cross(kSecond.center - kFirst.center, point - center);
  return (turn > 0) == (side == Beside::Left);
}

// CEN-179
TEST(Tangents, ALineIsTangentToBothCirclesOnTheGivenSides) {
  for (const Beside first : kSides) {
    for (const Beside second : kSides) {
      const auto points = tangent_points(TangentLine{kFirst, kSecond, first, second});
      ASSERT_TRUE(points);
      const PlaneVector line = points->on_second - points->on_first;
      const PlaneVector out = points->on_first - kFirst.center;
      const PlaneVector other = points->on_second - kSecond.center;
      EXPECT_NEAR(length(out), kFirst.radius, 1e-12);
      EXPECT_NEAR(length(other), kSecond.radius, 1e-12);
      EXPECT_NEAR(dot(line, out), 0, 1e-12);
      EXPECT_NEAR(dot(line, other), 0, 1e-12);
      EXPECT_TRUE(is_on(first, points->on_first, kFirst.center));
      EXPECT_TRUE(is_on(second, points->on_second, kSecond.center));
    }
  }
}

// CEN-180
TEST(Tangents, AnArcIsTangentToBothCirclesOnTheGivenSides) {
  constexpr double kRadius = 9;
  for (const Beside first : kSides) {
    for (const Beside second : kSides) {
      for (const Beside center : kSides) {
        const auto points =
            tangent_points(TangentArc{kFirst, kSecond, first, second, center, kRadius});
        ASSERT_TRUE(points);
        EXPECT_NEAR(length(points->on_first - kFirst.center), kFirst.radius, 1e-12);
        EXPECT_NEAR(length(points->on_second - kSecond.center), kSecond.radius, 1e-12);
        EXPECT_NEAR(length(points->on_first - points->center), kRadius, 1e-12);
        EXPECT_NEAR(length(points->on_second - points->center), kRadius, 1e-12);
        EXPECT_EQ(side_of(points->center) > 0, center == Beside::Left);
        EXPECT_TRUE(is_on(first, points->on_first, kFirst.center));
        EXPECT_TRUE(is_on(second, points->on_second, kSecond.center));
      }
    }
  }
}

TEST(Tangents, ImpossibleTangentsHaveNoResult) {
  const PlaneCircle inside{{0, 0}, 1};
  const PlaneCircle around{{0.5, 0}, 5};
  EXPECT_FALSE(tangent_points(TangentLine{inside, around, Beside::Left, Beside::Left}));
  EXPECT_FALSE(tangent_points(TangentLine{inside, inside, Beside::Left, Beside::Left}));
  EXPECT_FALSE(
      tangent_points(TangentArc{kFirst, kSecond, Beside::Left, Beside::Left, Beside::Left, 0.5}))
      << "does not reach";
  EXPECT_FALSE(circle_through({{0, 0}, {1, 1}, {3, 3}}));
  EXPECT_FALSE(circle_through({{0, 0}, {0, 0}, {3, 3}}));
}

// CEN-181
TEST(Tangents, ACircleGoesThroughThreePoints) {
  const auto found = circle_through({{5, 1}, {4, 2}, {3, 1}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(length(found->circle.center - PlaneVector{4, 1}), 0, 1e-12);
  EXPECT_NEAR(found->circle.radius, 1, 1e-12);
  EXPECT_TRUE(found->is_counterclockwise);
  EXPECT_FALSE(circle_through({{3, 1}, {4, 2}, {5, 1}})->is_counterclockwise);
}

}  // namespace
}  // namespace dripline::interpreter::centurion
