#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/stages/blending/path.hpp"

namespace dripline::interpreter::blending {
namespace {

// CEN-048, HD-106: a right angle; the arc takes its radius of both lines.
TEST(Corner, ARoundingTouchesBothLines) {
  Path path;
  path.round(5).line(40, 0).line(40, 30).end();
  expect_moves(path.log, {{{35, 0}}, {{40, 5}, {35, 5}, 90}, {{40, 30}}});
}

TEST(Corner, ARoundingToTheRightTurnsClockwise) {
  Path path;
  path.round(5).line(40, 0).line(40, -30).end();
  expect_moves(path.log, {{{35, 0}}, {{40, -5}, {35, -5}, -90}, {{40, -30}}});
}

// 60 degrees from straight on: the legs are r tan 30.
TEST(Corner, AnObtuseCornerTakesLessOfTheLines) {
  Path path;
  path.round(6).line(20, 0).line(30, 10 * std::sqrt(3.0)).end();
  const double leg = 6 * std::tan(Angle::kPi / 6);
  expect_moves(path.log, {{{20 - leg, 0}},
                          {{20 + leg / 2, leg * std::sqrt(3.0) / 2}, {20 - leg, 6}, 60},
                          {{30, 10 * std::sqrt(3.0)}}});
}

// The line along Y=0 and the circle of radius 10 about (10, 10) cross at right angles at (20, 10)
// reached upwards on X=20. The rounding of radius 2 outside that circle lies on X=18, 12 from the
// center: (18, 10 - sqrt(144 - 64)).
TEST(Corner, ARoundingBetweenALineAndAnArcTouchesBoth) {
  Path path{Policy{}, {20, -20}};
  path.round(2).line(20, 0);  // ends on the circle's level below
  path.arc({30, 0}, 90);      // leaves (20, 0) downwards: about (30, 0), to (30, -10)
  path.end();
  ASSERT_EQ(path.fault(), FaultKind::Straight) << "straight back";

  Path other{Policy{}, {0, 0}};
  // along X to (20, 0), then counterclockwise about (20, 10): tangent, straight on
  other.round(2).line(20, 0).arc({20, 10}, 90).end();
  EXPECT_EQ(other.fault(), FaultKind::Straight);

  Path third{Policy{}, {0, 0}};
  // along X to (20, 0), then about (30, 0) clockwise: starts upwards, a left turn of 90 degrees.
  // Center on Y=2, outside that circle by 2: 12 from (30, 0).
  third.round(2).line(20, 0).arc({30, 0}, -90).end();
  const PlaneVector center{30 - std::sqrt(144.0 - 4.0), 2};
  const PlaneVector touch = PlaneVector{30, 0} + (10.0 / 12) * (center - PlaneVector{30, 0});
  ASSERT_EQ(third.fault(), std::nullopt);
  ASSERT_EQ(third.log.moves.size(), 3u);
  EXPECT_NEAR(third.log.moves[0].to.first, center.first, 1e-9);
  EXPECT_NEAR(third.log.moves[1].to.first, touch.first, 1e-9);
  EXPECT_NEAR(third.log.moves[1].to.second, touch.second, 1e-9);
  EXPECT_NEAR(third.log.moves[1].center.second, 2, 1e-9);
  EXPECT_NEAR(third.log.moves[2].to.second, 10, 1e-9);
  EXPECT_NEAR(third.log.moves[2].sweep, -Angle::kPi / 2 + std::asin(touch.second / 10), 1e-9);
}

// Two half circles of radius 5 that meet at a right angle at the origin: about (-5, 0) arriving
// downwards, about (0, 5) leaving to the right... the rounding lies outside both or inside both.
TEST(Corner, ARoundingBetweenTwoArcsTouchesBoth) {
  Path path{Policy{}, {-5, 5}};
  // clockwise about (-5, 0): leaves (-5, 5) to the right and reaches (0, 0) downwards
  // then counterclockwise about (0, 5): leaves (0, 0) to the right
  path.round(1).arc({-5, 0}, -90).arc({0, 5}, 90).end();
  ASSERT_EQ(path.fault(), std::nullopt);
  ASSERT_EQ(path.log.moves.size(), 3u);
  const Move& piece = path.log.moves[1];
  // a left turn: outside the first circle (6 from its center), inside the second (4)
  EXPECT_NEAR(length(piece.center - PlaneVector{-5, 0}), 6, 1e-9);
  EXPECT_NEAR(length(piece.center - PlaneVector{0, 5}), 4, 1e-9);
  EXPECT_NEAR(length(piece.from - piece.center), 1, 1e-9);
  EXPECT_NEAR(length(piece.to - piece.center), 1, 1e-9);
  EXPECT_GT(piece.sweep, 0);
  EXPECT_NEAR(length(path.log.moves[0].to - PlaneVector{-5, 0}), 5, 1e-9);
  EXPECT_NEAR(path.log.moves[2].to.first, 5, 1e-9);
}

// CEN-049, HD-107
TEST(Corner, AChamferTakesItsLegOfBothLines) {
  Path path;
  path.chamfer(4).line(40, 0).line(40, 30).end();
  expect_moves(path.log, {{{36, 0}}, {{40, 4}}, {{40, 30}}});
}

TEST(Corner, AChamferMayBeMeasuredAlongItself) {
  Path path;
  path.chamfer(4, Chamfer::Face).line(40, 0).line(40, 30).end();
  const double leg = 4 / std::sqrt(2.0);
  expect_moves(path.log, {{{40 - leg, 0}}, {{40, leg}}, {{40, 30}}});
}

TEST(Corner, PiecesHaveTheFeedOfTheirElementOrTheirOwn) {
  Path path;
  path.round(5, Feed::per_minute(Length::mm(60))).line(40, 0);
  path.feed = Feed::per_minute(Length::mm(300));
  path.round(5).line(40, 30).line(0, 30).end();
  ASSERT_EQ(path.log.moves.size(), 5u);
  EXPECT_EQ(path.log.moves[1].feed, Feed::per_minute(Length::mm(60)));
  EXPECT_EQ(path.log.moves[3].feed, Feed::per_minute(Length::mm(300)));
}

TEST(Corner, CornersAtBothEndsOfAMove) {
  Path path;
  path.round(5).line(20, 0).chamfer(5).line(20, 10).line(0, 10).end();
  expect_moves(path.log, {{{15, 0}}, {{20, 5}, {15, 5}, 90}, {{15, 10}}, {{0, 10}}});
}

struct Refused {
  std::string name;
  void (*program)(Path&);
  FaultKind fault;
};
class RefusedCorner : public testing::TestWithParam<Refused> {};

// CEN-048, CEN-049
TEST_P(RefusedCorner, StatesWhy) {
  Policy policy;
  policy.refuses_open_corner = true;
  Path path{policy};
  GetParam().program(path);
  EXPECT_EQ(path.fault(), GetParam().fault);
  ASSERT_TRUE(path.blender.fault());
  EXPECT_FALSE(describe(*path.blender.fault()).empty());
}

INSTANTIATE_TEST_SUITE_P(
    , RefusedCorner,
    testing::Values(
        Refused{"straight_on", [](Path& p) { p.round(1).line(10, 0).line(20, 0); },
                FaultKind::Straight},
        Refused{"straight_back", [](Path& p) { p.round(1).line(10, 0).line(5, 0); },
                FaultKind::Straight},
        Refused{"line_to_tangent_arc",
                [](Path& p) {
                  p.round(1).line(10, 0).arc({10, 5}, 90);
                },
                FaultKind::Straight},
        Refused{"first_too_short", [](Path& p) { p.round(11).line(10, 0).line(10, 30); },
                FaultKind::DoesNotFit},
        Refused{"second_too_short", [](Path& p) { p.chamfer(5).line(10, 0).line(10, 4); },
                FaultKind::DoesNotFit},
        Refused{"both_ends_take_too_much",
                [](Path& p) { p.round(6).line(20, 0).round(6).line(20, 10).line(0, 10); },
                FaultKind::DoesNotFit},
        Refused{"chamfer_at_arc",
                [](Path& p) {
                  p.chamfer(1).line(10, 0).arc({20, 0}, -90);
                },
                FaultKind::ChamferAtArc},
        Refused{"nothing_follows", [](Path& p) { p.round(1).line(10, 0).rapid(0, 0); },
                FaultKind::OpenCorner},
        Refused{"nothing_before", [](Path& p) { p.round_block(1); }, FaultKind::NoElement}),
    [](const auto& i) { return i.param.name; });

TEST(Corner, WhereNothingFollowsItIsLeftOut) {
  Path path;
  path.round(1).line(10, 0).rapid(0, 0).chamfer(2).line(10, 5).end();
  expect_moves(path.log, {{{10, 0}}, {{0, 0}}, {{10, 5}}});
}

TEST(Corner, WhereThereIsNoneToRoundItIsLeftOutByChoice) {
  Policy policy;
  policy.refuses_straight_corner = false;
  Path path{policy};
  path.round(1).line(10, 0).line(20, 0).end();
  expect_moves(path.log, {{{10, 0}}, {{20, 0}}});
}

TEST(Corner, RapidMovesMayBeElements) {
  Policy policy;
  policy.blends_rapids = true;
  Path path{policy};
  path.rapid(40, 0).round_block(5).line(40, 30).end();
  expect_moves(path.log, {{{35, 0}}, {{40, 5}, {35, 5}, 90}, {{40, 30}}});
  EXPECT_EQ(path.log.moves[0].kind, Move::Kind::Rapid);
}

TEST(Corner, AChamferOfARapidMoveHasItsOwnFeed) {
  Policy policy;
  policy.blends_rapids = true;
  Path plain{policy};
  plain.rapid(40, 0).chamfer_block(5).rapid(40, 30).end();
  ASSERT_EQ(plain.log.moves.size(), 3u);
  EXPECT_EQ(plain.log.moves[1].kind, Move::Kind::Rapid);
  Path own{policy};
  own.rapid(40, 0).chamfer_block(5, Feed::per_minute(Length::mm(100))).rapid(40, 30).end();
  expect_moves(own.log, {{{35, 0}}, {{40, 5}}, {{40, 30}}});
  EXPECT_EQ(own.log.moves[1].kind, Move::Kind::Line);
}

}  // namespace
}  // namespace dripline::interpreter::blending
