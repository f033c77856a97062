#include <gtest/gtest.h>

#include "gateway/app/restart/approach.hpp"

namespace dripline::gateway {
namespace {

using interpreter::Axis;
using interpreter::PathArc;
using interpreter::Plane;
using interpreter::Position;
using interpreter::Turn;

Position z(double value) {
  Position position;
  position.set_raw(Axis::Z, value);
  return position;
}

Position xz(double x, double z) {
  Position position;
  position.set_raw(Axis::X, x);
  position.set_raw(Axis::Z, z);
  return position;
}

ReachedHeights begun_at(double z, double length = 0) {
  ReachedHeights heights;
  Position at;
  at.set_raw(Axis::Z, z);
  at.unmark_all();
  heights.begin(at, {0, 0, length});
  return heights;
}

ReachedHeights::Lengths tool(double length, bool shifts = true) {
  return {.of_axes = {0, 0, length}, .of_tool = {0, 0, length}, .shifts_position = shifts};
}

TEST(ReachedHeights, HaveThePlaceWhereTheRunBegan) {
  ReachedHeights heights = begun_at(50);
  heights.move(z(-5), {});
  EXPECT_EQ(heights.highest(Axis::Z, {}), 50);
  EXPECT_EQ(begun_at(-10, 60).highest(Axis::Z, {}), 50) << "where the axis is";
  EXPECT_FALSE(ReachedHeights().highest(Axis::Z, {})) << "not known";
}

/// The axis has been at 80 with the first tool, and the tip of it at 20.
TEST(ReachedHeights, AreForTheToolThatApproaches) {
  ReachedHeights heights = begun_at(0);
  heights.move(z(20), tool(60));
  heights.move(z(1), tool(60));
  EXPECT_EQ(heights.highest(Axis::Z, tool(60)), 20);
  EXPECT_EQ(heights.highest(Axis::Z, tool(10)), 70) << "the axis was there";
  EXPECT_EQ(heights.highest(Axis::Z, tool(100)), 20) << "its tip clears what the other one cleared";
}

/// Machine coordinates are without a length: the axis may not be able to go higher.
TEST(ReachedHeights, OfMachineCoordinatesAreThoseOfTheAxis) {
  ReachedHeights heights = begun_at(-100);
  heights.move(z(0), {.of_axes = {}, .of_tool = {0, 0, 60}, .shifts_position = true});
  EXPECT_EQ(heights.highest(Axis::Z, tool(60)), -60);
}

/// Without a shift an axis follows a length with its own next move.
TEST(ReachedHeights, TakeALengthWithTheMoveThatDoes) {
  ReachedHeights heights = begun_at(30);
  heights.move(z(20), tool(10, false));
  heights.move(z(20), tool(60, false));
  EXPECT_EQ(heights.axes.raw(Axis::Z), 30);
  heights.move(z(0), tool(60, false));
  EXPECT_EQ(heights.axes.raw(Axis::Z), 60);
}

struct ArcCase {
  const char* name;
  Turn turn;
  double to_x, to_z, sweep, highest;
};
class ArcHeight : public testing::TestWithParam<ArcCase> {};

/// About X0 Z0 in the plane of Z and X, from X10 Z0. Clockwise there is from X to Z.
TEST_P(ArcHeight, IsThatOfItsHighestPoint) {
  const ArcCase& one = GetParam();
  ReachedHeights heights = begun_at(0);
  heights.move(xz(10, 0), {});
  heights.axes.set_raw(Axis::Z, -100);
  heights.tip.set_raw(Axis::Z, -100);
  heights.move(xz(one.to_x, one.to_z),
               PathArc{Length{}, Length{}, Plane::ZX, one.turn, Angle::degrees(one.sweep)}, {});
  EXPECT_NEAR(*heights.highest(Axis::Z, {}), one.highest, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    , ArcHeight,
    testing::Values(ArcCase{"over_the_top", Turn::Clockwise, -10, 0, 180, 10},
                    ArcCase{"under_it", Turn::Counterclockwise, -10, 0, 180, 0},
                    ArcCase{"below_the_top", Turn::Clockwise, 6, 8, 53.13010235, 8},
                    ArcCase{"round_from_below", Turn::Counterclockwise, 6, 8, 306.8698976, 10},
                    ArcCase{"whole", Turn::Counterclockwise, 10, 0, 360, 10}),
    [](const auto& i) { return std::string{i.param.name}; });

Approach flat() {
  Approach approach;
  approach.from = xz(10, 5);
  approach.to = xz(0, 5);
  approach.highest = z(5);
  approach.is_clear = true;
  return approach;
}

TEST(ApproachHeights, RetractsBeforeAnotherToolAlsoAtThePlace) {
  Approach approach = flat();
  approach.highest = z(50);
  approach.from = approach.to;
  EXPECT_TRUE(approach.plan().before.empty());
  approach.changes_tool = true;
  const auto plan = approach.plan();
  EXPECT_EQ(plan.retracts, 1u);
  EXPECT_EQ(plan.before.at(0).to, z(50));
  EXPECT_EQ(plan.after.back().to, z(5));
}

/// A tool in an angle head leaves the part along its own axis.
TEST(ApproachHeights, RetractsAlongTheToolThatIsInTheSpindle) {
  Approach approach = flat();
  approach.highest = xz(80, 50);
  approach.changes_tool = true;
  approach.spindle_axis = Axis::X;
  const auto plan = approach.plan();
  ASSERT_EQ(plan.retracts, 2u);
  EXPECT_EQ(plan.before[0].to.raw(Axis::X), 80);
  EXPECT_EQ(plan.before[1].to, z(50));
  EXPECT_EQ(plan.before.at(2).to.raw(Axis::X), 0);
}

}  // namespace
}  // namespace dripline::gateway
