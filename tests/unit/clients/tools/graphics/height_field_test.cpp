#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "clients/tools/graphics/height_field.hpp"

namespace dripline::graphics {
namespace {

constexpr double kPi = 3.14159265358979323846;
const Cuboid kBlank{{0, 0, -20}, {100, 80, 0}};

HeightField blank(std::size_t cells = 500) {
  auto made = HeightField::make(kBlank, cells);
  EXPECT_TRUE(made) << made.error().what;
  return std::move(*made);
}
double at(const HeightField& field, double u, double v) {
  return field.at(static_cast<std::size_t>((u - field.extent().low.u) / field.cell()),
                  static_cast<std::size_t>((v - field.extent().low.v) / field.cell()));
}

TEST(HeightField, IsTheBlankBeforeAnythingCuts) {
  const HeightField field = blank();
  EXPECT_EQ(field.columns(), 500u);
  EXPECT_EQ(field.rows(), 400u);
  EXPECT_DOUBLE_EQ(field.cell(), 0.2);
  EXPECT_EQ(field.removed_volume(), 0);
}

TEST(HeightField, ASlotHasTheVolumeOfItsOutline) {
  HeightField field = blank(1000);
  field.cut({20, 40, -4}, {80, 40, -4}, 5);
  const double area = 60 * 10 + kPi * 25;
  EXPECT_NEAR(field.removed_volume(), area * 4, area * 4 * 0.002);
  EXPECT_FLOAT_EQ(static_cast<float>(at(field, 50, 44.9)), -4);
  EXPECT_EQ(at(field, 50, 45.2), 0);
  EXPECT_EQ(at(field, 14.8, 40), 0);
}

TEST(HeightField, APlungeIsARoundHole) {
  HeightField field = blank(1000);
  field.cut({30, 30, 5}, {30, 30, -6}, 7);
  EXPECT_NEAR(field.removed_volume(), kPi * 49 * 6, kPi * 49 * 6 * 0.002);
}

/// Falling 1 in 10: where the flat end last covers a point, it has gone on by the radius.
TEST(HeightField, ARampIsAsDeepAsTheCutterLeavesIt) {
  HeightField field = blank(1000);
  field.cut({0, 40, 0}, {100, 40, -10}, 5);
  EXPECT_NEAR(at(field, 50.05, 40.05), -5.5, 0.02);
  EXPECT_NEAR(at(field, 50.05, 44.05), -5.3, 0.02);  // half a chord of 3 beside the middle line
  HeightField back = blank(1000);
  back.cut({100, 40, -10}, {0, 40, 0}, 5);
  EXPECT_EQ(field.heights(), back.heights()) << "the return cuts the same";
}

TEST(HeightField, CutsThroughEndAtTheBottom) {
  HeightField field = blank();
  field.cut({50, 40, 10}, {50, 40, -35}, 10);
  EXPECT_EQ(at(field, 50.1, 40.1), -20);
}

TEST(HeightField, WhatIsAboveOrBesideTheBlankCutsNothing) {
  HeightField field = blank();
  field.cut({0, 0, 0}, {100, 80, 3}, 5);
  field.cut({-40, -40, -10}, {-6, -6, -10}, 5);
  field.cut({1e9, 1e9, -5}, {2e9, 1e9, -5}, 5);
  EXPECT_EQ(field.removed_volume(), 0);
}

TEST(HeightField, ADetailShowsThePartOfTheWhole) {
  auto detail = HeightField::make({{40, 30, -20}, {60, 50, 0}}, 200);
  ASSERT_TRUE(detail);
  detail->cut({0, 40, -3}, {100, 40, -3}, 5);
  EXPECT_NEAR(detail->removed_volume(), 20 * 10 * 3, 1);
}

TEST(HeightField, RefusesBlanksWithoutVolumeAndTooManyCells) {
  EXPECT_EQ(HeightField::make({{0, 0, 0}, {10, 0, 5}}, 100).error().code, Errc::LimitExceeded);
  EXPECT_EQ(HeightField::make({{0, 0, 0}, {10, 10, -1}}, 100).error().code, Errc::LimitExceeded);
  EXPECT_EQ(HeightField::make(kBlank, 0).error().code, Errc::LimitExceeded);
  EXPECT_EQ(HeightField::make(kBlank, 5000).error().code, Errc::LimitExceeded);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(HeightField::make({{0, 0, 0}, {nothing, 1, 1}}, 10));
}

}  // namespace
}  // namespace dripline::graphics
