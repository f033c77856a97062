#include "clients/tools/post/arc_fit.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace dripline::post {
namespace {

using interpreter::Arc;
using interpreter::Axis;
using interpreter::Position;
using interpreter::Turn;
using interpreter::Units;

Grid grid_of(std::string_view target, Units units = Units::Millimeter) {
  return Grid(**find_target(target), units);
}

Arc arc_about(double x, double y, double radius, double from, double sweep, Position& start) {
  const double begin = from * Angle::kPi / 180, end = (from + sweep) * Angle::kPi / 180;
  start.set(Axis::X, Length::mm(x + radius * std::cos(begin)));
  start.set(Axis::Y, Length::mm(y + radius * std::sin(begin)));
  Arc arc;
  arc.to = start;
  arc.to.set(Axis::X, Length::mm(x + radius * std::cos(end)));
  arc.to.set(Axis::Y, Length::mm(y + radius * std::sin(end)));
  arc.center_first = Length::mm(x);
  arc.center_second = Length::mm(y);
  arc.turn = Turn::Counterclockwise;
  arc.sweep = Angle::degrees(sweep);
  return arc;
}

TEST(FitArc, OneOnTheGridIsItself) {
  Position start;
  const Arc arc = arc_about(10, 20, 5, 0, 90, start);
  const auto fitted = fit_arc(grid_of("fanuc"), start, arc, 0.001);
  EXPECT_TRUE(fitted.is_possible);
  EXPECT_EQ(fitted.first, -5000);
  EXPECT_EQ(fitted.second, 0);
  EXPECT_LT(fitted.deviation, 1e-9);
  EXPECT_LT(fitted.radius_error, 1e-9);
}

TEST(FitArc, AFullCircleStaysOne) {
  Position start;
  const Arc arc = arc_about(0.0004, 0.0003, 3.00017, 33, 360, start);
  const auto fitted = fit_arc(grid_of("fanuc"), start, arc, 0.001);
  EXPECT_TRUE(fitted.is_possible);
  EXPECT_LE(fitted.deviation, 0.001);
  EXPECT_EQ(fitted.radius_error, 0);
}

/// Neither end on the grid, nor the center.
TEST(FitArc, RoundedArcsStayNearOnes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-100, 100), size(0.5, 80), angle(0, 360),
      sweep(2, 358);
  int within = 0;
  constexpr int kArcs = 400;
  for (int i = 0; i < kArcs; ++i) {
    Position start;
    const Arc arc =
        arc_about(place(random), place(random), size(random), angle(random), sweep(random), start);
    const auto fitted = fit_arc(grid_of("fanuc"), start, arc, 0.001);
    ASSERT_TRUE(fitted.is_possible);
    EXPECT_LT(fitted.deviation, 0.0022) << i;
    EXPECT_LT(fitted.radius_error, 0.002) << i;
    within += fitted.deviation <= 0.001 ? 1 : 0;
  }
  EXPECT_GT(within, kArcs / 2);
}

/// Nearly a quarter of a step long: the rounded ends are one point, or are in reverse order.
TEST(FitArc, NeverMakesAWholeCircleOfALittleArc) {
  for (const double sweep : {0.001, 0.002, 0.004, 0.01}) {
    Position start;
    const Arc arc = arc_about(0, 0, 10, 45, sweep, start);
    const auto fitted = fit_arc(grid_of("fanuc"), start, arc, 0.001);
    if (fitted.is_possible) {
      EXPECT_LE(fitted.deviation, 0.01) << sweep;
    }
  }
}

TEST(DistanceFromChord, IsTheSagitta) {
  Position start;
  const Arc arc = arc_about(0, 0, 10, 0, 60, start);
  EXPECT_NEAR(distance_from_chord(start, arc), 10 * (1 - std::cos(Angle::kPi / 6)), 2e-3);
}

TEST(PointOf, LiesOnTheArc) {
  Position start;
  Arc arc = arc_about(1, 2, 4, 0, 180, start);
  arc.to.set(Axis::Z, Length::mm(-6));
  const Position middle = point_of(start, arc, 0.5);
  EXPECT_NEAR(middle.raw(Axis::X), 1, 1e-12);
  EXPECT_NEAR(middle.raw(Axis::Y), 6, 1e-12);
  EXPECT_NEAR(middle.raw(Axis::Z), -3, 1e-12);
}

TEST(Grid, CountsEachPositionByItself) {
  const Grid grid = grid_of("fanuc");
  double at = 0;
  for (int i = 1; i <= 100'000; ++i) {
    at = i * 0.0003;
    const double off = grid.machine(Axis::X, grid.counts(Axis::X, at)) - at;
    ASSERT_LE(std::fabs(off), 0.0005 + 1e-12) << i;
  }
}

TEST(Grid, ADiameterCountsTwice) {
  const Grid grid = grid_of("fanuc-t");
  EXPECT_EQ(grid.counts(Axis::X, 10), 20'000);
  EXPECT_EQ(grid.counts(Axis::Z, 10), 10'000);
  EXPECT_DOUBLE_EQ(grid.machine(Axis::X, 20'001), 10.0005);
}

struct NumberCase {
  const char* name;
  std::int64_t counts;
  int decimals;
  NumberLook look;
  const char* text;
};
class AppendNumber : public testing::TestWithParam<NumberCase> {};
TEST_P(AppendNumber, WritesTheNumber) {
  std::string text;
  append_number(text, GetParam().counts, GetParam().decimals, GetParam().look);
  EXPECT_EQ(text, GetParam().text);
}
INSTANTIATE_TEST_SUITE_P(
    , AppendNumber,
    testing::Values(NumberCase{"zero", 0, 3, {}, "0"}, NumberCase{"whole", 12'000, 3, {}, "12"},
                    NumberCase{"with_point", 12'000, 3, {.has_point = true}, "12."},
                    NumberCase{"fraction", -5, 3, {}, "-0.005"},
                    NumberCase{"comma", 1'500, 3, {.has_plus = true, .point = ','}, "+1,5"},
                    NumberCase{"none", 42, 0, {}, "42"}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace dripline::post
