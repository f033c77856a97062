#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

namespace dripline::interpreter::compensation {

// Corners that a block of its own goes round.

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

const double kRoot2 = std::sqrt(2.0);

Policy with(OutsideCorner outside) {
  Policy policy;
  policy.outside = outside;
  return policy;
}

void expect_ends(const PathLog& log, const std::vector<PlaneVector>& ends) {
  ASSERT_EQ(log.moves.size(), ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR(log.moves[i].to.first, ends[i].first, kNear) << "move " << i;
    EXPECT_NEAR(log.moves[i].to.second, ends[i].second, kNear) << "move " << i;
  }
}

TEST(Corner, InsideCornersAreTheIntersectionOfOffsetLines) {
  Contour contour{Policy{}, {30, 10}};
  contour.left(4).line(30, 0).line(60, 0).line(60, 40).line(0, 40).line(0, 0).line(30, 0);
  contour.off().line(30, 10);
  expect_ends(contour.log, {{30, 4}, {56, 4}, {56, 36}, {4, 36}, {4, 4}, {30, 4}, {30, 10}});
}

TEST(Corner, OutsideRightAnglesAreExtendedToOnePoint) {
  Contour contour{Policy{}, {-9, -9}};
  contour.left(3).line(0, 0).line(0, 20).line(30, 20).line(30, 0).line(0, 0).off().line(-9, -9);
  expect_ends(contour.log, {{-3, 0}, {-3, 23}, {33, 23}, {33, -3}, {0, -3}, {-9, -9}});
}

TEST(Corner, SharpOutsideCornersGetTwoPoints) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(2).line(0, 0).line(10, 0).line(0, -10).off().line(-20, -10);
  const double d = 2 / kRoot2;
  expect_ends(contour.log, {{0, 2}, {12, 2}, {10 + 2 * d, 0}, {d, -10 - d}, {-20, -10}});
  EXPECT_EQ(contour.log.moves[2].origin.block, 3u) << "belongs to the second block";
}

TEST(Corner, ArcsGoOnAlongTheirTangents) {
  Contour contour{Policy{}, {-20, 0}};
  // a quarter circle, then to the right at a right angle to its end
  contour.left(2).line(-10, 0).line(0, 0).arc({0, 10}, 90).line(30, 10).off().line(30, 20);
  expect_ends(contour.log, {{-10, 2}, {0, 2}, {8, 10}, {8, 12}, {30, 12}, {30, 20}});
  EXPECT_EQ(contour.log.moves[2].kind, Move::Kind::Arc);
  EXPECT_NEAR(contour.log.moves[2].sweep, Angle::degrees(90).radians(), kNear);
}

TEST(Corner, ArcsToArcsRoundSharpCornersWithThreePieces) {
  Contour sharp{Policy{}, {-20, -10}};
  sharp.left(1).line(-10, -10).line(0, -10).arc({0, 0}, 90).arc({20, 0}, 90).off().line(40, 40);
  // the first ends upwards, the second begins downwards: the tool goes round the end
  expect_ends(sharp.log,
              {{-10, -9}, {0, -9}, {9, 0}, {9, 1}, {11, 1}, {11, 0}, {20, -9}, {40, 40}});
}

TEST(Corner, TransitionArcsTurnAboutTheCorner) {
  Contour contour{with(OutsideCorner::Arc), {-20, 0}};
  contour.left(2).line(0, 0).line(10, 0).line(0, -10).off().line(-20, -10);
  const double d = 2 / kRoot2;
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10 + d, -d}, {d, -10 - d}, {-20, -10}});
  const Move& arc = contour.log.moves[2];
  EXPECT_EQ(arc.kind, Move::Kind::Arc);
  EXPECT_NEAR(arc.center.first, 10, kNear);
  EXPECT_NEAR(arc.sweep, Angle::degrees(-135).radians(), kNear);
  EXPECT_EQ(arc.feed, contour.feed);
}

TEST(Corner, TheToolGoesRoundTheEndOfALineAndBack) {
  Contour contour{with(OutsideCorner::Arc), {-20, 0}};
  contour.right(2).line(0, 0).line(10, 0).line(0, 0).off().line(-20, 0);
  expect_ends(contour.log, {{0, -2}, {10, -2}, {10, 2}, {0, 2}, {-20, 0}});
  EXPECT_NEAR(contour.log.moves[2].sweep, Angle::degrees(180).radians(), kNear);
  Contour other_side{with(OutsideCorner::Arc), {-20, 0}};
  other_side.left(2).line(0, 0).line(10, 0).line(0, 0).off().line(-20, 0);
  EXPECT_NEAR(other_side.log.moves[2].sweep, Angle::degrees(-180).radians(), kNear);
}

TEST(Corner, BeforeARapidTheToolDoesNotCutTheCorner) {
  Contour contour{with(OutsideCorner::Arc), {-20, 0}};
  contour.left(2).line(0, 0).line(10, 0).rapid(10, -30).off().rapid(0, -40);
  expect_ends(contour.log, {{0, 2}, {12, 2}, {12, -30}, {0, -40}});
}

TEST(Corner, CurvesAreProlongedToTheirIntersection) {
  Contour contour{with(OutsideCorner::IntersectCurves), {-20, 0}};
  contour.left(2).line(0, 0).line(10, 0).line(0, -10).off().line(-20, -10);
  const double spike = 2 / std::tan(Angle::degrees(22.5).radians());
  const double d = 2 / kRoot2;
  expect_ends(contour.log, {{0, 2}, {10 + spike, 2}, {d, -10 - d}, {-20, -10}});
}

TEST(Corner, OneCornerMayBeShapedOtherwise) {
  Contour contour{with(OutsideCorner::Arc), {-20, 0}};
  contour.left(2).line(0, 0);
  contour.compensator.shape_next_corner(OutsideCorner::IntersectCurves);
  contour.line(10, 0).line(10, -10).line(0, -10).off().line(0, -20);
  expect_ends(contour.log, {{0, 2}, {12, 2}, {12, -10}, {10, -12}, {0, -12}, {0, -20}});
}

TEST(Corner, LinesMeetArcsInside) {
  Contour contour{Policy{}, {-20, 5}};
  // a line runs into a bump of radius 10 about (20, 0)
  contour.left(2).line(0, 0).line(10, 0).arc({20, 0}, -180).line(50, 0).off().line(50, 20);
  const double foot = std::sqrt(12.0 * 12 - 4);
  expect_ends(contour.log, {{0, 2}, {20 - foot, 2}, {20 + foot, 2}, {50, 2}, {50, 20}});
  EXPECT_EQ(contour.fault(), std::nullopt);
}

TEST(Corner, ArcsMeetArcsInside) {
  Contour contour{Policy{}, {-30, 5}};
  // two half circles of radius 10 side by side
  contour.left(2).line(-20, 0).line(-10, 0).arc({0, 0}, -180).arc({20, 0}, -180).line(50, 0);
  contour.off().line(50, 20);
  const double foot = std::sqrt(12.0 * 12 - 4);
  const double valley = std::sqrt(12.0 * 12 - 100);
  expect_ends(contour.log, {{-20, 2}, {-foot, 2}, {10, valley}, {20 + foot, 2}, {50, 2}, {50, 20}});
}

TEST(Corner, TangentCornersNeedNoPiece) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(2).line(-10, 0).line(0, 0).arc({0, 10}, 90).line(10, 30).arc({0, 30}, 90);
  contour.line(-10, 40).off().line(-20, 40);
  expect_ends(contour.log, {{-10, 2}, {0, 2}, {8, 10}, {8, 30}, {0, 38}, {-10, 38}, {-20, 40}});
}

TEST(Corner, AFullCircleKeepsItsTurn) {
  Contour contour{Policy{}, {0, -5}};
  contour.left(2).line(20, -5).line(20, 0).arc({0, 0}, 360).line(20, 5).off().line(0, 5);
  expect_ends(contour.log, {{18, -5}, {18, 0}, {18, 0}, {18, 5}, {0, 5}});
  EXPECT_NEAR(contour.log.moves[2].sweep, Angle::degrees(360).radians(), kNear);
}

TEST(Corner, AnArcOfTheCuttersOwnRadiusIsAPoint) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(2).line(-10, 0).line(0, 0).arc({0, 2}, 90).line(2, 20).off().line(-5, 20);
  expect_ends(contour.log, {{-10, 2}, {0, 2}, {0, 20}, {-5, 20}});
}

TEST(Corner, OtherAxesMoveOnTheElementItself) {
  Contour contour{with(OutsideCorner::Arc), {-20, 0}};
  contour.left(2).line(0, 0).line(10, 0).aside(-3).line(10, -10).off().line(0, -10);
  ASSERT_EQ(contour.log.moves.size(), 6u);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10, 2}, {12, 0}, {12, -10}, {0, -10}});
  EXPECT_EQ(contour.log.moves[1].z, 0);
  EXPECT_EQ(contour.log.moves[2].z, -3) << "made at the end of the element before";
  EXPECT_EQ(contour.log.moves[3].z, -3);
}

TEST(Corner, InverseTimeIsSharedByTheInsertedPieces) {
  Contour contour{with(OutsideCorner::Arc), {-20, 0}};
  contour.feed = Feed::inverse_time(2);
  contour.left(2).line(0, 0).line(10, 0).line(10, -10).off().line(0, -10);
  const double corner = Angle::degrees(90).radians() * 2;
  EXPECT_NEAR(contour.log.moves[2].feed.moves_per_minute(), 2 * (corner + 10) / corner, kNear);
  EXPECT_NEAR(contour.log.moves[3].feed.moves_per_minute(), 2 * (corner + 10) / 10, kNear);
}

TEST(Corner, SidesChangeOnTheNormals) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).right(2).line(20, 0).off().line(30, 0);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10, -2}, {20, -2}, {30, 0}});
}

TEST(Corner, RadiiChangeAtTheCorner) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).left(3).line(20, 0).line(20, 20);
  contour.left(1).line(0, 20).off().line(0, 10);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10, 3}, {17, 3}, {17, 19}, {0, 19}, {0, 10}});
}

TEST(Corner, ANegativeRadiusIsTheOtherSide) {
  Contour contour{Policy{}, {-10, 0}};
  contour.right(-2).line(0, 0).line(10, 0).off().line(20, 0);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {20, 0}});
}

TEST(Corner, ALatheTipFollowsItsNose) {
  Contour contour{Policy{}, {5, 20}, Plane::ZX};
  contour.compensator.turn_on({.plane = Plane::ZX,
                               .side = Side::Right,
                               .radius = Length::mm(0.8),
                               .tip_first = Length::mm(-0.8),
                               .tip_second = Length::mm(-0.8)});
  // turning toward the chuck at X 10, then facing outwards
  contour.line(2, 10).line(-20, 10).line(-20, 15).off().line(5, 20);
  expect_ends(contour.log, {{1.2, 10}, {-20, 10}, {-20, 14.2}, {5, 20}});
}

}  // namespace

}  // namespace dripline::interpreter::compensation
