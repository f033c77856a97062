#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

namespace dripline::interpreter::compensation {
namespace {

constexpr double kNear = 1e-9;

void expect_ends(const PathLog& log, const std::vector<PlaneVector>& ends) {
  ASSERT_EQ(log.moves.size(), ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR(log.moves[i].to.first, ends[i].first, kNear) << "move " << i;
    EXPECT_NEAR(log.moves[i].to.second, ends[i].second, kNear) << "move " << i;
  }
}

Policy corners_at_both_ends() {
  Policy policy;
  policy.start_up = StartUp::Corner;
  policy.cancel = Cancel::Corner;
  return policy;
}
Policy tangential() {
  Policy policy;
  policy.start_up = StartUp::Tangent;
  return policy;
}

TEST(StartUp, OffMovesPassAsTheyAre) {
  Contour contour{Policy{}};
  contour.rapid(1, 2).line(3, 4).arc({3, 9}, 90).misc(8);
  expect_ends(contour.log, {{1, 2}, {3, 4}, {8, 9}});
  EXPECT_FALSE(contour.compensator.is_waiting());
}

TEST(StartUp, EndsOnTheNormalOfTheNextElement) {
  Contour contour{Policy{}, {-10, -10}};
  contour.left(2).line(0, 0).arc({0, -5}, -90).off().line(20, -5);
  expect_ends(contour.log, {{0, 2}, {7, -5}, {20, -5}});
}

TEST(StartUp, AsACornerGoesRoundTheOutside) {
  Contour contour{corners_at_both_ends(), {0, -20}};
  contour.left(2).line(0, 0).line(20, 0).off().line(20, -20);
  expect_ends(contour.log, {{-2, 2}, {22, 2}, {20, -20}});
}

TEST(StartUp, AsASharpCornerHasTwoPoints) {
  Contour contour{corners_at_both_ends(), {20, -20}};
  contour.left(2).line(0, 0).line(20, 0).off().line(0, -20);
  const double d = std::sqrt(2.0);
  expect_ends(contour.log, {{-2 * d, 0}, {-2, 2}, {22, 2}, {20 + 2 * d, 0}, {0, -20}});
}

TEST(StartUp, AsACornerInsideIsOnTheNextNormal) {
  Contour contour{corners_at_both_ends(), {0, 20}};
  contour.left(2).line(0, 0).line(20, 0).off().line(20, 20);
  expect_ends(contour.log, {{0, 2}, {20, 2}, {20, 20}});
}

TEST(StartUp, TangentiallyTouchesTheCircleAboutItsEnd) {
  Contour contour{tangential(), {0, 0}};
  contour.right(6).line(10, 0).line(10, 20).off().line(30, 20);
  // the line from (0, 0) at a sine of 6/10 is tangent to the circle, then follows it to the normal
  expect_ends(contour.log, {{6.4, -4.8}, {16, 0}, {16, 20}, {30, 20}});
  EXPECT_NEAR(contour.log.moves[1].center.first, 10, kNear);
  EXPECT_GT(contour.log.moves[1].sweep, 0);
}

TEST(StartUp, TangentiallyTooCloseIsAFault) {
  Contour contour{tangential(), {0, 0}};
  contour.right(6).line(6, 0).line(6, 20);
  EXPECT_EQ(contour.fault(), FaultKind::StartUpTooClose);
  EXPECT_NEAR(contour.compensator.fault()->value.mm(), 6, kNear);
  EXPECT_TRUE(contour.log.moves.empty());
}

TEST(StartUp, WaitsForAMoveInThePlane) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).empty_block().aside(-4).misc(8).empty_block().line(0, 0).line(20, 0);
  contour.compensator.flush();
  expect_ends(contour.log, {{-10, 0}, {0, 2}, {20, 2}});
  EXPECT_EQ(contour.log.moves[2].z, -4);
}

TEST(StartUp, FollowedByTheCancelMoveEndsOnItsOwnNormal) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).off().line(0, 10);
  expect_ends(contour.log, {{0, 2}, {0, 10}});
}

TEST(StartUp, OnAnArcIsAFault) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).arc({0, 0}, 90);
  EXPECT_EQ(contour.fault(), FaultKind::StartUpNotStraight);
  EXPECT_EQ(contour.compensator.fault()->origin.block, 1u);
}

TEST(StartUp, CancelOnAnArcIsAFault) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).off().arc({10, 10}, 90);
  EXPECT_EQ(contour.fault(), FaultKind::CancelNotStraight);
}

TEST(StartUp, AfterACancelAloneMovesOfOtherAxesKeepTheToolInItsPlace) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).off().empty_block().aside(50).line(20, 0);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10, 2}, {20, 0}});
  EXPECT_FALSE(contour.compensator.is_on());
}

TEST(StartUp, SwitchedOnAgainWithoutAMoveTheContourGoesOn) {
  Contour contour{corners_at_both_ends(), {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).off().left(2).line(10, 20);
  contour.off().line(0, 20);
  EXPECT_NEAR(contour.log.moves[1].to.first, 8, kNear);
}

TEST(StartUp, LeavingEndsOnTheNormalAndGoesStraight) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0);
  contour.compensator.cancel();
  contour.aside(30).line(20, 10).left(2).line(30, 10).line(40, 10).off().line(50, 0);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10, 2}, {20, 10}, {30, 12}, {40, 12}, {50, 0}});
}

TEST(StartUp, LeavingInParallelKeepsTheDistance) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0);
  contour.compensator.cancel_in_parallel();
  contour.line(10, 40).aside(-1).right(2).line(0, 40).line(-10, 40).off().line(-20, 0);
  expect_ends(contour.log, {{0, 2}, {10, 2}, {10, 42}, {10, 42}, {0, 42}, {-10, 42}, {-20, 0}});
}

TEST(StartUp, AnotherPlaneStartsAnew) {
  Contour contour{corners_at_both_ends(), {-10, 0}};
  contour.left(2).line(0, 0).line(10, 0).off();
  ASSERT_TRUE(contour.compensator.is_waiting()) << "for the cancel move";
  contour.compensator.turn_on({.plane = Plane::ZX,
                               .side = Side::Left,
                               .radius = Length::mm(2),
                               .tip_first = {},
                               .tip_second = {}});
  contour.aside(-30).line(30, 0);
  contour.compensator.flush();
  // in ZX now: down along Z, then to X 30 with the tool on the side of smaller Z
  ASSERT_EQ(contour.log.moves.size(), 4u);
  EXPECT_NEAR(contour.log.moves[1].to.second, 2, kNear) << "ended on its own normal";
  EXPECT_NEAR(contour.log.moves[3].z, -32, kNear);
  EXPECT_NEAR(contour.log.moves[3].to.first, 30, kNear);
}

TEST(StartUp, ARadiusOfZeroFollowsTheProgram) {
  Contour contour{Policy{}, {-10, 0}};
  contour.left(0).line(0, 0).line(10, 0).line(10, -10).arc({0, -10}, -90).off().line(0, 0);
  expect_ends(contour.log, {{0, 0}, {10, 0}, {10, -10}, {0, -20}, {0, 0}});
  Policy rounding = corners_at_both_ends();
  rounding.outside = OutsideCorner::Arc;
  Contour corners{rounding, {0, -10}};
  corners.left(0).line(0, 0).line(10, 0).line(10, -10).off().line(0, -10);
  expect_ends(corners.log, {{0, 0}, {10, 0}, {10, -10}, {0, -10}});
}

TEST(StartUp, FlushedContoursContinueFromWhereTheToolIs) {
  Policy policy;
  Contour straight{policy, {-10, 0}};
  straight.left(2).line(0, 0).line(10, 0).empty_block().empty_block().line(10, -20).off();
  expect_ends(straight.log, {{0, 2}, {10, 2}, {12, -20}});
  policy.resume = Resume::OwnNormal;
  Contour normal{policy, {-10, 0}};
  normal.left(2).line(0, 0).line(10, 0).empty_block().empty_block().line(10, -20).off();
  expect_ends(normal.log, {{0, 2}, {10, 2}, {12, 0}, {12, -20}});
}

}  // namespace
}  // namespace dripline::interpreter::compensation
