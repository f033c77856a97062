#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/stages/compensation/contour.hpp"

namespace dripline::interpreter::compensation {
namespace {

TEST(Fault, ACurveThatMissesItsNeighborHasNoIntersection) {
  Policy policy;
  policy.outside = OutsideCorner::IntersectCurves;
  Contour contour{policy, {-20, 0}};
  // inside the arc the tool runs on a radius of 3, 5 below the line that follows to the right
  contour.left(5).line(-10, 0).line(0, 0).arc({0, 8}, 90).line(30, 8);
  EXPECT_EQ(contour.fault(), FaultKind::NoIntersection);
  EXPECT_EQ(contour.compensator.fault()->origin.block, 3u);
  EXPECT_EQ(contour.compensator.fault()->next.block, 4u);
}

TEST(Fault, AnArcSmallerThanTheCutterNamesBothRadii) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(5).line(-10, 0).line(0, 0).arc({0, 4}, 90);
  ASSERT_EQ(contour.fault(), FaultKind::ArcTooSmall);
  EXPECT_EQ(describe(*contour.compensator.fault(), Units::Millimeter),
            "arc radius 4 mm is smaller than the cutter radius 5 mm");
  EXPECT_EQ(describe(*contour.compensator.fault(), Units::Inch),
            "arc radius 0.1575 in is smaller than the cutter radius 0.1969 in");
}

TEST(Fault, AStepBelowTheRadiusRunsBackwards) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(5).line(-10, 0).line(0, 0).line(0, 4).line(-3, 4).line(-3, 30);
  EXPECT_EQ(contour.fault(), FaultKind::Reversed);
  EXPECT_EQ(contour.compensator.fault()->origin.block, 3u);
}

TEST(Fault, AnArcThatItsCornersEatUpRunsBackwards) {
  Contour contour{Policy{}, {-30, 0}};
  // a flat bump between two walls
  contour.left(5).line(-20, 0).line(-2, 0).arc({0, -10}, -10).line(2, 30);
  EXPECT_EQ(contour.fault(), FaultKind::Reversed);
}

TEST(Fault, ConcaveCornersMayBeRefused) {
  Policy policy;
  policy.inside = InsideCorner::Refuse;
  policy.outside = OutsideCorner::Arc;
  Contour contour{policy, {-20, 0}};
  contour.left(2).line(-10, 0).line(0, 0).line(10, -10).line(20, -10);
  EXPECT_EQ(contour.fault(), FaultKind::ConcaveCorner);
  EXPECT_EQ(contour.compensator.fault()->origin.block, 3u);
}

TEST(Fault, AnArcInAnotherPlaneIsNone) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(2).line(-10, 0);
  Arc arc;
  arc.plane = Plane::YZ;
  contour.compensator.on_arc(arc);
  EXPECT_EQ(contour.fault(), FaultKind::OtherPlane);
}

TEST(Fault, MoreBetweenTwoMovesThanFitsIsRefused) {
  Policy policy;
  policy.blocks_without_motion = 1'000;
  Contour contour{policy, {-20, 0}};
  contour.left(2).line(-10, 0).line(0, 0);
  for (std::size_t i = 0; i < look_ahead::kMaxHeldEvents; ++i) contour.misc(8);
  EXPECT_EQ(contour.fault(), std::nullopt);
  contour.misc(8);
  EXPECT_EQ(contour.fault(), FaultKind::TooMuchBetween);
}

TEST(Fault, NothingFollowsAFaultButAnAlarm) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(5).line(-10, 0).line(0, 0).arc({0, 4}, 90);
  const std::size_t words = contour.log.words.size();
  contour.line(100, 0).misc(8).off().line(0, 0);
  contour.compensator.on_end({});
  EXPECT_EQ(contour.log.words.size(), words);
}

TEST(Fault, AResetClearsIt) {
  Contour contour{Policy{}, {-20, 0}};
  contour.left(5).arc({0, 4}, 90);
  contour.compensator.reset({});
  EXPECT_EQ(contour.fault(), std::nullopt);
  contour.line(1, 1);
  EXPECT_EQ(contour.log.moves.size(), 1u);
}

}  // namespace
}  // namespace dripline::interpreter::compensation
