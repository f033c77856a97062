#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/stages/blending/path.hpp"

/// Ends that the program only approximates, and back-solved lines.
namespace dripline::interpreter::blending {
namespace {

// The circle of 5 about (20, 0) is cut by Y=3 at X=16 and X=24.
TEST(Blend, ALineIsExtendedOrShortenedToItsArc) {
  for (const double end : {9.0, 15.5, 17.0, 19.5}) {
    Path path{Policy{}, {0, 3}};
    path.approximate().line(end, 3).approximate(5).arc_to({20, 0}, {25, 0}, -100).end();
    expect_moves(path.log, {{{16, 3}}, {{25, 0}, {20, 0}, -180 + 36.86989764584402}});
  }
}

TEST(Blend, TheNearerOfTwoPointsIsTaken) {
  Path path{Policy{}, {0, 3}};
  path.approximate().line(21, 3).approximate(5).arc_to({20, 0}, {20, -5}, -90).end();
  expect_moves(path.log, {{{24, 3}}, {{20, -5}, {20, 0}, -126.86989764584402}});
}

// From (0, 0), 13 away, the tangent to the circle of 5 is 12 long and meets it at 144/13, +-60/13.
TEST(Blend, ALineThatMissesIsTurnedUntilItTouches) {
  Path path;
  path.approximate()
      .line(12, 9)
      .approximate(5)
      .arc_to({13, 0}, {12, -9}, -90)
      .approximate()
      .line(0, 0);
  path.end();
  const double along = 144.0 / 13, beside = 60.0 / 13;
  const double sweep = 360 - 2 * (180 - Angle::radians(std::acos(5.0 / 13)).degrees());
  expect_moves(path.log, {{{along, beside}}, {{along, -beside}, {13, 0}, -360 + sweep}, {{0, 0}}});
}

// 5 and 5 about points 6 apart meet 4 beside the middle.
TEST(Blend, ArcsEndWhereTheirCirclesMeet) {
  Path path{Policy{}, {-5, 0}};
  path.approximate(5)
      .arc_to({0, 0}, {2, 5}, -110)
      .approximate(5)
      .arc_to({6, 0}, {11, 0}, -110)
      .end();
  expect_moves(path.log,
               {{{3, 4}, {0, 0}, -126.86989764584402}, {{11, 0}, {6, 0}, -126.86989764584402}});
}

TEST(Blend, APointWithinTheToleranceIsKept) {
  Path path{Policy{}, {0, 3}};
  path.approximate().line(16.005, 3).approximate(5).arc_to({20, 0}, {25, 0}, -143).end();
  ASSERT_EQ(path.log.moves.size(), 2u);
  EXPECT_EQ(path.log.moves[0].to, (PlaneVector{16.005, 3}));
  EXPECT_NEAR(Angle::radians(path.log.moves[1].sweep).degrees(), -143, 1e-9) << "as programmed";
}

TEST(Blend, ARoundingSitsAtTheTrueCorner) {
  Path path{Policy{}, {0, 3}};
  path.approximate().round(1).line(9, 3).approximate(5).arc_to({20, 0}, {25, 0}, -100).end();
  // outside the circle (6) and 1 above the line
  const PlaneVector center{20 - std::sqrt(36.0 - 16), 4};
  ASSERT_EQ(path.log.moves.size(), 3u);
  EXPECT_NEAR(path.log.moves[0].to.first, center.first, 1e-9);
  EXPECT_NEAR(length(path.log.moves[1].center - center), 0, 1e-9);
  EXPECT_NEAR(length(path.log.moves[1].to -
                     (PlaneVector{20, 0} + (5.0 / 6) * (center - PlaneVector{20, 0}))),
              0, 1e-9);
}

TEST(Blend, ALineLedBackMeetsTheLineBefore) {
  for (const double slope : {135.0, -45.0, 315.0}) {
    Path path;
    path.line(3, 0).back(slope).line(0, 20).end();
    expect_moves(path.log, {{{20, 0}}, {{0, 20}}});
  }
}

// The line of slope 45 through (-8, -18) meets the circle of 10 at (0, -10) and (10, 0).
TEST(Blend, ALineLedBackMeetsTheArcBeforeNearOrFar) {
  for (const Back which : {Back::Nearest, Back::Farthest}) {
    Path path{Policy{}, {-10, 0}};
    path.arc({0, 0}, 30).back(45, which).line(-8, -18).end();
    const bool is_near = which == Back::Nearest;
    expect_moves(
        path.log,
        {{is_near ? PlaneVector{0, -10} : PlaneVector{10, 0}, {0, 0}, is_near ? 90.0 : 180.0},
         {{-8, -18}}});
  }
}

TEST(Blend, ALineLedBackMayEndInAnEstimate) {
  Path path;
  path.line(3, 0)
      .approximate()
      .back(90)
      .line(20, 7)
      .approximate(5)
      .arc_to({17, 14}, {12, 14}, 90)
      .end();
  // up X=20 to the circle of 5 about (17, 14): Y = 10
  expect_moves(path.log, {{{20, 0}}, {{20, 10}}, {{12, 14}, {17, 14}, 233.13010235415598}});
}

struct Refused {
  std::string name;
  void (*program)(Path&);
  FaultKind fault;
};
class RefusedBlend : public testing::TestWithParam<Refused> {};

TEST_P(RefusedBlend, StatesWhy) {
  Path path;
  GetParam().program(path);
  EXPECT_EQ(path.fault(), GetParam().fault);
  const std::size_t before = path.log.words.size();
  path.line(1, 1).end();
  EXPECT_EQ(path.log.words.size(), before) << "a fault is final";
}

INSTANTIATE_TEST_SUITE_P(
    , RefusedBlend,
    testing::Values(Refused{"parallel", [](Path& p) { p.line(3, 0).back(0).line(9, 2); },
                            FaultKind::NoIntersection},
                    Refused{"line_back_misses_arc",
                            [](Path& p) {
                              p.arc({10, 0}, 90).back(0).line(30, 30);
                            },
                            FaultKind::NoIntersection},
                    Refused{"meets_beyond_any_machine",
                            [](Path& p) { p.line(3, 0).back(1e-9).line(9, 2); },
                            FaultKind::NoIntersection},
                    Refused{"no_number",
                            [](Path& p) {
                              p.line(3, 0).approximate().line(6, 1).approximate(1e200);
                              p.arc_to({1e200, 0}, {9, 9}, 90).end();
                            },
                            FaultKind::NoIntersection},
                    Refused{"nothing_to_lead_back_to", [](Path& p) { p.back(45).line(9, 2); },
                            FaultKind::NoElement},
                    Refused{"arcs_apart",
                            [](Path& p) {
                              p.line(-5, 0).approximate(5).arc_to({0, 0}, {2, 5}, -90);
                              p.approximate(5).arc_to({60, 0}, {65, 0}, -90);
                            },
                            FaultKind::ArcsApart},
                    Refused{"arc_begins_off_its_circle",
                            [](Path& p) {
                              p.approximate(5).arc_to({20, 0}, {25, 0}, -90);
                            },
                            FaultKind::OffArc},
                    Refused{"line_of_other_data",
                            [](Path& p) {
                              p.line(9, 3).approximate(5).arc_to({20, 0}, {25, 0}, -90);
                            },
                            FaultKind::OffArc},
                    Refused{"arc_ends_off_its_circle",
                            [](Path& p) {
                              p.line(15, 0).approximate(5).arc_to({20, 0}, {26, 0}, -90).end();
                            },
                            FaultKind::OffArc}),
    [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace dripline::interpreter::blending
