// The approach of a mill leads across only at a height that the run has shown to be clear.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "gateway/app/restart/approach.hpp"
#include "tests/unit/gateway/app/restart/mill_stock.hpp"

namespace dripline::gateway {
namespace {

using interpreter::Axis;
using interpreter::Position;
using HeightKind = ReachedHeights::Kind;
using testing::HasSubstr;

Position xyz(double x, double y, double z) {
  Position position;
  position.set_raw(Axis::X, x);
  position.set_raw(Axis::Y, y);
  position.set_raw(Axis::Z, z);
  return position;
}
/// The program has not named Z.
Position xy(double x, double y, double z) {
  Position position = xyz(x, y, z);
  position.unmark(Axis::Z);
  return position;
}

struct Step {
  Position to;
  HeightKind kind = HeightKind::Feed;
};
const auto rapid = [](const Position& to) { return Step{to, HeightKind::Rapid}; };
const auto feed = [](const Position& to) { return Step{to}; };

struct RunCase {
  const char* name;
  double begun;  ///< height, over X0 Y0
  std::vector<Step> steps;
  bool is_clear;
};
class ClearHeight : public testing::TestWithParam<RunCase> {};

TEST_P(ClearHeight, IsWhatTheRunHasShown) {
  const RunCase& run = GetParam();
  ReachedHeights heights;
  Position begun = xyz(0, 0, run.begun);
  begun.unmark_all();
  heights.begin(begun, {});
  for (const Step& step : run.steps) heights.move(step.to, {}, step.kind);
  EXPECT_EQ(heights.is_clear(Axis::Z, *heights.highest(Axis::Z, {}), {}), run.is_clear);
}

INSTANTIATE_TEST_SUITE_P(
    , ClearHeight,
    testing::Values(
        RunCase{"none_of_feed_alone", -5, {feed(xyz(9, 0, -5)), feed(xyz(9, 9, -5))}, false},
        RunCase{"none_of_two_cuts", -5, {feed(xyz(9, 0, -3)), feed(xyz(9, 9, -5))}, false},
        RunCase{"none_of_a_program_without_z", -5, {feed(xy(9, 0, -5))}, false},
        RunCase{"none_of_a_rapid_as_deep_as_the_cuts",
                2,
                {rapid(xy(9, 0, 2)), feed(xy(9, 9, 2))},
                false},
        RunCase{"of_a_first_move_across",
                50,
                {rapid(xy(9, 9, 50)), rapid(xyz(9, 9, 2)), feed(xyz(9, 9, -5))},
                true},
        RunCase{"of_a_first_move_across_and_down",
                50,
                {rapid(xyz(9, 9, -5)), feed(xyz(20, 9, -5))},
                true},
        RunCase{"of_a_first_move_far_down", 50, {feed(xyz(0, 0, -5)), feed(xyz(9, 0, -5))}, true},
        RunCase{"none_of_a_first_move_a_little_down",
                2,
                {feed(xyz(0, 0, -5)), feed(xyz(9, 0, -5))},
                false},
        RunCase{
            "none_where_it_cut_higher_since", 20, {feed(xyz(0, 0, 0)), feed(xyz(9, 0, 30))}, false},
        RunCase{"of_a_retraction",
                0,
                {feed(xyz(0, 0, -5)), feed(xyz(9, 0, -5)), rapid(xyz(9, 0, 30))},
                true},
        RunCase{"of_a_retraction_where_all_moves_across_are_feed",
                0,
                {rapid(xyz(0, 0, 15)), feed(xyz(9, 0, 15)), feed(xyz(9, 0, -5)),
                 rapid(xyz(9, 0, 15)), feed(xyz(0, 0, 15))},
                true},
        RunCase{"none_of_a_rapid_up_to_where_it_cuts",
                0,
                {rapid(xyz(0, 0, 20)), feed(xyz(9, 0, 20))},
                false},
        RunCase{"none_of_a_chip_cleared_in_the_hole",
                2,
                {feed(xyz(0, 0, -3)), rapid(xyz(0, 0, -2)), feed(xyz(0, 0, -6))},
                false},
        RunCase{"none_of_a_clearance_that_was_fed_to_and_across",
                0,
                {feed(xyz(0, 0, 5)), feed(xyz(9, 0, 5)), feed(xyz(9, 0, -5)), feed(xyz(20, 0, -5)),
                 feed(xyz(20, 0, 5)), feed(xyz(0, 0, 5))},
                false},
        RunCase{"none_of_a_table_that_turns",
                -5,
                {feed(xyz(9, 0, -5)), rapid([] {
                   Position turned = xyz(9, 0, -5);
                   turned.set_raw(Axis::A, 90);
                   return turned;
                 }())},
                false}),
    [](const auto& i) { return std::string{i.param.name}; });

Approach unclear() {
  Approach approach;
  approach.from = xyz(10, 20, -5);
  approach.to = xyz(30, 20, -5);
  approach.highest = xyz(0, 0, -5);
  return approach;
}

TEST(MillApproach, IsLeftToTheOperatorWhereNoHeightIsClear) {
  const auto plan = unclear().plan();
  EXPECT_THAT(plan.fault, HasSubstr("the axes are at X10.000, and no height is known to be clear"));
  EXPECT_THAT(plan.fault, HasSubstr("where it was fed across it may have cut"));
  EXPECT_THAT(plan.fault, HasSubstr("Bring the axes to X30.000 by hand or by MDI (machine "
                                    "coordinates), along Z out of the part first, and restart "
                                    "again: it moves to Z-5.000 there"));
  EXPECT_TRUE(plan.before.empty());
  EXPECT_TRUE(plan.after.empty());
}

TEST(MillApproach, GoesDownWhereTheAxesWereBrought) {
  Approach approach = unclear();
  approach.from = xyz(30.001, 20, 40);
  const auto plan = approach.plan();
  EXPECT_EQ(plan.fault, "");
  ASSERT_EQ(plan.after.size(), 2u);
  EXPECT_EQ(plan.after[1].to.raw(Axis::Z), -5);
}

/// Out of the part along a tool in an angle head is back into it along the same line.
TEST(MillApproach, ComesBackAlongAnotherToolAtAClearHeightAlone) {
  Approach approach = unclear();
  approach.from = approach.to;
  approach.highest = xyz(80, 0, -5);
  approach.changes_tool = true;
  approach.spindle_axis = Axis::X;
  EXPECT_NE(approach.plan().fault, "");
  approach.is_clear = true;
  EXPECT_EQ(approach.plan().fault, "");
}

/// Random programs in a block, which begin within it or beside it: feeds anywhere, rapids up a
/// little in what was cut, or out of the block, and across out of the block alone.
class RandomMill {
 public:
  explicit RandomMill(unsigned seed) : random_(seed) {
    Position begun = xyz(part() * 44 - 2, part() * 44 - 2, -1 - part() * 6);
    at_.push_back(begun);
    highest_feed_ = begun.raw(Axis::Z);
    stock.cut(begun, begun);
    begun.unmark_all();
    heights.begin(begun, {});
  }
  void step() {
    const Position& now = at_.back();
    Position to = now;
    const bool is_out = now.raw(Axis::Z) > 0;
    const double what = part();
    HeightKind kind = HeightKind::Feed;
    if (what < 0.3 || (is_out && what < 0.6)) {
      to = xyz(part() * 44 - 2, part() * 44 - 2, now.raw(Axis::Z));
      if (is_out && part() < 0.7) kind = HeightKind::Rapid;
    } else if (what < 0.7) {
      to.set_raw(Axis::Z, std::max(-9.0, now.raw(Axis::Z) - part() * (is_out ? 12 : 3)));
    } else if (what < 0.85 && !is_out) {
      // below where it went in: back up there would be out of the part, as far as a run shows
      to.set_raw(Axis::Z, std::min(highest_feed_ - 0.1, now.raw(Axis::Z) + part()));
      if (to.raw(Axis::Z) < now.raw(Axis::Z)) return;
      kind = HeightKind::Rapid;
    } else if (what > 0.93) {
      to.set_raw(Axis::Z, 3 + part() * 20);
      kind = HeightKind::Rapid;
    }
    if (to.same_point(now)) return;
    if (kind == HeightKind::Feed) highest_feed_ = std::max(highest_feed_, now.raw(Axis::Z));
    stock.cut(now, to);
    heights.move(to, {}, kind);
    at_.push_back(to);
  }
  Approach approach() {
    Approach approach;
    approach.from = at_.back();
    approach.to = at_[static_cast<std::size_t>(part() * static_cast<double>(at_.size() - 1))];
    approach.highest.set_raw(Axis::Z, *heights.highest(Axis::Z, {}));
    approach.is_clear = heights.is_clear(Axis::Z, approach.highest.raw(Axis::Z), {});
    return approach;
  }
  /// Deepest of the rapids in material.
  double depth(const Approach& approach, const Approach::Plan& plan) {
    double depth = 0;
    Position now = approach.from;
    for (const auto* moves : {&plan.before, &plan.after}) {
      for (const ApproachMove& move : *moves) {
        Position to = now;
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
          if (move.to.has(axis)) to.set_raw(axis, move.to.raw(axis));
        if (!move.feed) depth = std::max(depth, stock.depth(now, to));
        now = to;
      }
    }
    return depth;
  }

  MillStock stock;
  ReachedHeights heights;

 private:
  double part() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::mt19937 random_;
  std::vector<Position> at_;
  double highest_feed_ = 0;
};

TEST(MillApproach, LeadsInRapidThroughNoMaterial) {
  int led = 0, refused = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    RandomMill mill(seed);
    for (int i = 0; i < 3 + static_cast<int>(seed % 12); ++i) mill.step();
    const Approach approach = mill.approach();
    const auto plan = approach.plan();
    plan.fault.empty() ? ++led : ++refused;
    EXPECT_LE(mill.depth(approach, plan), 1e-6) << "seed " << seed;
  }
  EXPECT_GT(led, 50);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace dripline::gateway
