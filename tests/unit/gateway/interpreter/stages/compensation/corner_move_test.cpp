#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

/// Corners that a block of its own goes round.
namespace dripline::interpreter::compensation {
namespace {

using testing::ElementsAre;

constexpr double kNear = 1e-9;
constexpr double kPi = Angle::kPi;

void expect_arc(const Move& move, PlaneVector to, PlaneVector center, double sweep) {
  EXPECT_EQ(move.kind, Move::Kind::Arc);
  EXPECT_NEAR(move.to.first, to.first, kNear);
  EXPECT_NEAR(move.to.second, to.second, kNear);
  EXPECT_NEAR(move.center.first, center.first, kNear);
  EXPECT_NEAR(move.center.second, center.second, kNear);
  EXPECT_NEAR(move.sweep, sweep, kNear);
}

TEST(CornerMove, IsAnArcOfItsOwnBlock) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).round().line(10, -10).off();
  ASSERT_EQ(contour.log.moves.size(), 4u);
  expect_arc(contour.log.moves[2], {12, 0}, {10, 0}, -kPi / 2);
  EXPECT_THAT(contour.log.words,
              ElementsAre("move1", "/1", "move2", "/2", "move3", "/3", "move4", "/4"));
}

TEST(CornerMove, RoundASharpPointIsMoreThanAQuarter) {
  Contour contour{Policy{}, {-10, 0}};
  contour.right(3).line(0, 0).line(10, 0).round().line(0, 10).off();
  const double d = 3 / std::sqrt(2.0);
  ASSERT_EQ(contour.log.moves.size(), 4u);
  expect_arc(contour.log.moves[2], {10 + d, d}, {10, 0}, 3 * kPi / 4);
}

TEST(CornerMove, WhereThePathTurnsBackIsHalfACircleOutside) {
  for (const double side : {1.0, -1.0}) {
    Contour contour{Policy{}, {-10, 0}};
    contour.on(side > 0 ? Side::Left : Side::Right, 2).line(0, 0).line(10, 0).round().line(0, 0);
    contour.off();
    ASSERT_EQ(contour.log.moves.size(), 4u) << side;
    expect_arc(contour.log.moves[2], {10, -2 * side}, {10, 0}, -side * kPi);
  }
}

TEST(CornerMove, ToAnArcEndsOnTheNormalOfItsBegin) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).round().arc({5, 0}, -90).off();
  ASSERT_EQ(contour.log.moves.size(), 4u);
  expect_arc(contour.log.moves[2], {12, 0}, {10, 0}, -kPi / 2);
  expect_arc(contour.log.moves[3], {5, -7}, {5, 0}, -kPi / 2);
}

TEST(CornerMove, ToADirectionIsMadeAtOnce) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).round(PlaneVector{0.6, -0.8});
  ASSERT_EQ(contour.log.moves.size(), 3u);
  expect_arc(contour.log.moves[2], {11.6, 1.2}, {10, 0}, -std::atan2(0.8, 0.6));
  contour.line(16, -8).off();
  EXPECT_NEAR(contour.log.moves[3].to.first, 17.6, kNear);
  EXPECT_NEAR(contour.log.moves[3].to.second, -6.8, kNear);
}

TEST(CornerMove, StraightOnThereIsNothingToGoRound) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).round().line(20, 0).off();
  EXPECT_EQ(contour.log.moves.size(), 3u);
  EXPECT_EQ(contour.fault(), std::nullopt);
}

TEST(CornerMove, AfterTheLookAheadHasEndedItStillStartsFromTheNormal) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).misc(8).misc(9).round().line(10, -10).off();
  ASSERT_EQ(contour.log.moves.size(), 4u);
  expect_arc(contour.log.moves[2], {12, 0}, {10, 0}, -kPi / 2);
}

TEST(CornerMove, AnInsideCornerIsAFault) {
  Contour open{Policy{}, {-10, 0}};
  open.left(2).line(0, 0).line(10, 0).round().line(10, 10);
  EXPECT_EQ(open.fault(), FaultKind::ConcaveCorner);
  Contour known{Policy{}, {-10, 0}};
  known.left(2).line(0, 0).line(10, 0).round(PlaneVector{0, 1});
  EXPECT_EQ(known.fault(), FaultKind::ConcaveCorner);
}

TEST(CornerMove, NeedsACompensatedMoveBefore) {
  Contour off{Policy{}};
  EXPECT_TRUE(off.line(10, 0).round().goes_round) << "nothing is offset";
  Contour starting{Policy{}};
  EXPECT_FALSE(starting.left(2).round().goes_round);
  Contour without_radius{Policy{}};
  EXPECT_TRUE(without_radius.left(0).line(10, 0).round().line(10, -5).goes_round);
  EXPECT_EQ(without_radius.log.moves.size(), 2u - 1u) << "only the waiting one is held back";
}

TEST(CornerMove, SurvivesASnapshotWhileItWaits) {
  Contour whole{Policy{}, {-10, 0}};
  whole.left(2).line(0, 0).line(10, 0).round().line(10, -10).off();
  Contour first{Policy{}, {-10, 0}};
  first.left(2).line(0, 0).line(10, 0).round();
  Contour second{Policy{}, {-10, 0}};
  second.left(2).line(0, 0).line(10, 0).round();  // the same programmed place
  second.log.moves.clear();
  second.compensator.reset({});
  ASSERT_TRUE(second.compensator.restore(first.compensator.state()));
  second.line(10, -10).off();
  ASSERT_EQ(second.log.moves.size(), 2u);
  expect_arc(second.log.moves[0], whole.log.moves[2].to, {10, 0}, whole.log.moves[2].sweep);
}

}  // namespace
}  // namespace dripline::interpreter::compensation
