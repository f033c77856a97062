#include "clients/tools/approximation/arc_approximation.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

/// Circles by straight lines. Rows: TK-55.
namespace dripline::interpreter {
namespace {

double from_center(double x, double y) {
  return std::hypot(x, y);
}

struct MethodCase {
  const char* name;
  ArcMethod method;
  double inside, outside;  ///< how far the path may leave the circle, in tolerances
};
class Approximation : public testing::TestWithParam<MethodCase> {};

TEST_P(Approximation, NeverLeavesItsTolerance) {
  for (const double radius : {0.8, 12.5, 300.0}) {
    for (const double tolerance : {0.002, 0.05}) {
      for (const double sweep : {5.0, 47.3, 90.0, 180.0, 360.0, -90.0, -271.0}) {
        const auto points = approximate({{},
                                         {},
                                         Length::mm(radius),
                                         Angle::degrees(33),
                                         Angle::degrees(sweep),
                                         Length::mm(tolerance),
                                         GetParam().method});
        ASSERT_TRUE(points);
        const auto& path = *points;
        EXPECT_NEAR(from_center(path.front().x.mm(), path.front().y.mm()), radius, 1e-9);
        EXPECT_NEAR(from_center(path.back().x.mm(), path.back().y.mm()), radius, 1e-9);
        for (std::size_t i = 1; i < path.size(); ++i) {
          for (const double along : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double x = path[i - 1].x.mm() * (1 - along) + path[i].x.mm() * along;
            const double y = path[i - 1].y.mm() * (1 - along) + path[i].y.mm() * along;
            const double away = from_center(x, y) - radius;
            EXPECT_LE(away, GetParam().outside * tolerance + 1e-9);
            EXPECT_GE(away, -GetParam().inside * tolerance - 1e-9);
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Approximation,
                         testing::Values(MethodCase{"chord_inside", ArcMethod::Chord, 1, 0},
                                         MethodCase{"tangent_outside", ArcMethod::Tangent, 0, 1},
                                         MethodCase{"secant_both", ArcMethod::Secant, 1, 1}),
                         [](const auto& row) { return std::string{row.param.name}; });

std::size_t steps(ArcMethod method) {
  const auto points =
      approximate({{}, {}, Length::inch(2), {}, Angle::degrees(180), Length::inch(0.002), method});
  return points->size() - 1;
}

TEST(ApproximationSteps, AreAsFewAsTheMethodAllows) {
  // Radius 2, tolerance .002: a chord of 5.125 degrees, so 36 for half a circle; a tangent of 5.123
  // in 36 with two half steps; secants of 7.24 and tangents of 5.12 at the ends: 25 and two.
  EXPECT_EQ(steps(ArcMethod::Chord), 36U);
  EXPECT_EQ(steps(ArcMethod::Tangent), 37U);
  EXPECT_EQ(steps(ArcMethod::Secant), 27U);
}

TEST(ApproximationLimits, AreNamed) {
  const auto error = [](double radius, double tolerance, double sweep) {
    const auto points = approximate({{},
                                     {},
                                     Length::mm(radius),
                                     {},
                                     Angle::degrees(sweep),
                                     Length::mm(tolerance),
                                     ArcMethod::Chord});
    return points ? std::string() : points.error().what;
  };
  EXPECT_EQ(error(0, 0.1, 90), "radius: must be above 0");
  EXPECT_EQ(error(1, 0, 90), "tolerance: must be above 0 and below half the radius");
  EXPECT_EQ(error(1, 0.1, 400), "sweep: 400 degrees are not within 360, or none");
  EXPECT_NE(error(1e9, 1e-6, 360), "");
}

}  // namespace
}  // namespace dripline::interpreter
