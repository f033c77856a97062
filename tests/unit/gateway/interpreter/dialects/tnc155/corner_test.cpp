#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

std::vector<std::string> path(const std::string& radius, std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(), {"TOOL DEF 1 L+0 R" + radius, "TOOL CALL 1 Z S100"});
  return moves_of(blocks);
}

// HD-105: line and line; the corner itself is not reached.
TEST(TncCorner, ARoundingTouchesBothLines) {
  EXPECT_THAT(moves_of({"L X+0 Y+10 R0 F100", "L X+0 Y+0", "L X+40 Y+0", "RND R5", "L X+40 Y+30"}),
              ElementsAre("L X0 Y10 F100", "L X0 Y0 F100", "L X35 Y0 F100",
                          "A X40 Y5 c35,5 ccw90 F100", "L X40 Y30 F100"));
}

// HD-105: line and arc. The line y = 0 ends at (20, 0) on the circle of 20 about (20, 20), which it
// touches; the second line leaves the arc at (40, 20) along -X: a corner of 90 degrees. R 4: the
// center is 4 below y = 20 and 16 from (20, 20): (20 + sqrt(240), 16).
TEST(TncCorner, ARoundingTouchesAnArcAndALine) {
  const auto moves = moves_of({"L X+0 Y+0 R0 F100", "L X+20 Y+0", "CC X+20 Y+20", "C X+40 Y+20 DR+",
                               "RND R4", "L X+0 Y+20"});
  ASSERT_EQ(moves.size(), 4u);
  EXPECT_EQ(moves[0], "L X20 Y0 F100");
  EXPECT_EQ(moves[1].substr(0, 20), "A X39.365 Y15 c20,20");
  EXPECT_EQ(moves[2].substr(0, 25), "A X35.492 Y20 c35.492,16 ");
  EXPECT_EQ(moves[3], "L X0 Y20 F100");
}

// HD-105, HD-107: F MAX is its block's alone, so the piece between has the feed of the contour.
TEST(TncCorner, ACornerOfRapidSidesHasTheFeedOfTheContour) {
  const std::string start = "L X+0 Y+0 R0 F100";
  EXPECT_THAT(moves_of({start, "L X+40 Y+0 F MAX", "RND R5", "L X+40 Y+30"}),
              ElementsAre("R X35 Y0", "A X40 Y5 c35,5 ccw90 F100", "L X40 Y30 F100"));
  EXPECT_THAT(moves_of({start, "L X+40 Y+0 F MAX", "RND R5", "L X+40 Y+30 F MAX"}),
              ElementsAre("R X35 Y0", "A X40 Y5 c35,5 ccw90 F100", "R X40 Y30"));
  EXPECT_THAT(moves_of({start, "L X+40 Y+0 F MAX", "L 5", "L X+40 Y+30 F MAX"}),
              ElementsAre("R X35 Y0", "L X40 Y5 F100", "R X40 Y30"));
  EXPECT_THAT(run_text("%3 G71 *\nN1 G17 G40 G90 G01 X+0 Y+10 F100 *\nN2 X+0 Y+0 *\n"
                       "N3 G00 X+40 Y+0 G25 R5 *\nN4 G01 X+40 Y+30 *\nN9999 %3 G71 *\n")
                  .events,
              testing::Contains("A X40 Y5 c35,5 ccw90 F100"));
}

// HD-105, HD-107: and where there is none yet, nothing is made up.
TEST(TncCorner, ACornerWithoutAnyFeedIsRefused) {
  for (const char* corner : {"RND R5", "L 5"}) {
    EXPECT_THAT(
        moves_of({"L X+0 Y+10 R0 F MAX", "L X+40 Y+10 F MAX", corner, "L X+40 Y+30 F MAX"}).back(),
        "! FEED RATE MISSING")
        << corner;
  }
  EXPECT_THAT(
      moves_of({"L X+0 Y+10 R0 F MAX", "L X+40 Y+10 F MAX", "RND R0", "L X+40 Y+30 F MAX"}).back(),
      "R X40 Y30");
}

// HD-105, HD-106: in a compensated contour inner arcs get R - r, outer ones R + r; with R below r
// the tool does not fit.
TEST(TncCorner, RoundingsAreCompensatedAsArcs) {
  EXPECT_THAT(path("+4", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "RND R10",
                          "L X+40 Y+30", "L X+20 Y+30 R0"}),
              ElementsAre("L X0 Y20 F100", "L X0 Y4 F100", "L X30 Y4 F100",
                          "A X36 Y10 c30,10 ccw90 F100", "L X36 Y30 F100", "L X20 Y30 F100"));
  EXPECT_THAT(path("+4", {"L X+0 Y-20 R0 F100", "L X+0 Y+0 RR", "L X+40 Y+0", "RND R10",
                          "L X+40 Y+30", "L X+60 Y+30 R0"}),
              ElementsAre("L X0 Y-20 F100", "L X0 Y-4 F100", "L X30 Y-4 F100",
                          "A X44 Y10 c30,10 ccw90 F100", "L X44 Y30 F100", "L X60 Y30 F100"));
  EXPECT_THAT(path("+4", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "RND R3",
                          "L X+40 Y+30", "L X+20 Y+30 R0"})
                  .back(),
              "! TOOL RADIUS TOO LARGE");
}

// HD-106
TEST(TncCorner, ARoundingNeedsRoomAndThePlane) {
  EXPECT_THAT(moves_of({"L X+0 Y+0 R0 F100", "L X+4 Y+0", "RND R5", "L X+4 Y+30"}).back(),
              "! ROUNDING RADIUS TOO LARGE");
  EXPECT_THAT(moves_of({"L X+0 Y+10 R0 F100", "L X+40", "RND R5", "L X+40 Y+30"}).back(),
              "! PLANE WRONGLY DEFINED");
  EXPECT_THAT(moves_of({"L X+0 Y+10 R0 F100", "L X+40 Y+0 Z+1", "RND R5", "L X+40 Y+30"}).back(),
              "! PLANE WRONGLY DEFINED");
  EXPECT_THAT(moves_of({"L X+0 Y+10 R0 F100", "L X+40 Y+0", "RND R5", "L Y+30"}).back(),
              "! PLANE WRONGLY DEFINED");
  EXPECT_THAT(moves_of({"RND R5", "L X+40 Y+0 R0 F100"}).back(), "! PLANE WRONGLY DEFINED");
}

// HD-106: each directly follows the block whose end it changes.
TEST(TncCorner, OneBlockHasOneCorner) {
  for (const char* second : {"RND R6", "L 6"}) {
    for (const char* first : {"RND R5", "L 5"}) {
      EXPECT_THAT(
          moves_of({"L X+0 Y+0 R0 F100", "L X+40 Y+0", first, second, "L X+40 Y+30"}).back(),
          "! PLANE WRONGLY DEFINED")
          << first << " " << second;
    }
  }
}

// HD-107: both legs measured from the corner.
TEST(TncCorner, AChamferCutsBothLegs) {
  EXPECT_THAT(moves_of({"L X+0 Y+10 R0 F100", "L X+0 Y+0", "L X+40 Y+0", "L 4,000", "L X+40 Y+30"}),
              ElementsAre("L X0 Y10 F100", "L X0 Y0 F100", "L X36 Y0 F100", "L X40 Y4 F100",
                          "L X40 Y30 F100"));
  EXPECT_THAT(moves_of({"L X+0 Y+0 R0 F100", "L X+3 Y+0", "L 4", "L X+3 Y+30"}).back(),
              "! ROUNDING RADIUS TOO LARGE");
  EXPECT_THAT(moves_of({"L X+0 Y+1 R0 F100", "L X+3", "L 2", "L X+3 Y+30"}).back(),
              "! PLANE WRONGLY DEFINED");
}

// HD-107: the chamfer belongs to the contour that ends after it: offset by 5, from y = 5 to its
// own end at (40, 4) + 5 * (-1, 1) / sqrt(2).
TEST(TncCorner, AChamferBeforeTheEndIsCompensated) {
  EXPECT_THAT(
      path("+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "L 4", "L X+40 Y+30 R0"}),
      ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X33.929 Y5 F100", "L X36.464 Y7.536 F100",
                  "L X40 Y30 F100"));
}

// HD-108: P1' (0, 4), center (0, 12); the tangent from (-30, 40) touches at (-6.494, 7.328).
TEST(TncCorner, ARoundingAfterTheFirstPointIsARunOn) {
  EXPECT_THAT(
      path("+4", {"L X-30 Y+40 R0 F100", "L X+0 Y+0 RL", "RND R8", "L X+40 Y+0", "L X+40 Y+30 R0"}),
      ElementsAre("L X-30 Y40 F100", "L X-6.494 Y7.328 F100", "A X0 Y4 c0,12 ccw54.267 F100",
                  "L X40 Y4 F100", "L X40 Y30 F100"));
}

// HD-109: the mirror image of the tangential approach about x = 20.
TEST(TncCorner, ARoundingBeforeTheEndIsARunOff) {
  EXPECT_THAT(
      path("+4", {"L X+0 Y+40 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "RND R8", "L X+70 Y+40 R0"}),
      ElementsAre("L X0 Y40 F100", "L X0 Y4 F100", "L X40 Y4 F100",
                  "A X46.494 Y7.328 c40,12 ccw54.267 F100", "L X70 Y40 F100"));
}

// HD-109: the arc keeps the feed of the contour, however fast the block after it is.
TEST(TncCorner, ARunOffArcKeepsTheFeedOfTheContour) {
  EXPECT_THAT(path("+4", {"L X+0 Y+40 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "RND R8",
                          "L X+70 Y+40 R0 F MAX"}),
              ElementsAre("L X0 Y40 F100", "L X0 Y4 F100", "L X40 Y4 F100",
                          "A X46.494 Y7.328 c40,12 ccw54.267 F100", "R X70 Y40"));
}

// HD-108, HD-109: an arc is not made at rapid traverse, but at the highest feed there is.
TEST(TncCorner, ArcsToAndFromARapidContourHaveTheHighestFeed) {
  EXPECT_THAT(
      path("+4", {"L X-30 Y+40 R0 F100", "L X+0 Y+0 RL", "RND R8", "L X+40 Y+0 F MAX", "RND R8",
                  "L X+70 Y+40 R0 F100"}),
      ElementsAre("L X-30 Y40 F100", "L X-6.494 Y7.328 F100", "A X0 Y4 c0,12 ccw54.267 F15999",
                  "R X40 Y4", "A X46.494 Y7.328 c40,12 ccw54.267 F15999", "L X70 Y40 F100"));
}

// HD-108, HD-109: in ISO the words say which one it is, and the place has to agree.
TEST(TncCorner, ApproachAndDepartureStandWhereTheySay) {
  const auto iso = [](const std::string& blocks) {
    return run_text(
        "%3 G71 *\nN1 G99 T1 L+0 R+4 *\nN2 T1 G17 S100 *\n"
        "N3 G01 G40 G90 X-30 Y+40 F100 *\n" +
        blocks + "N9999 %3 G71 *\n");
  };
  EXPECT_EQ(iso("N4 X+0 Y+0 *\nN5 G26 R8 *\nN6 X+40 *\n").alarm_id, "TNC-PATH-OFFSET");
  EXPECT_EQ(iso("N4 G41 X+0 Y+0 *\nN5 X+40 *\nN6 G26 R8 *\nN7 X+40 Y+30 *\n").alarm_id,
            "TNC-PLANE");
  EXPECT_EQ(iso("N4 G41 X+0 Y+0 *\nN5 X+40 Y+0 *\nN6 G26 R8 *\nN7 X+40 Y+30 *\n").alarm_id,
            "TNC-PATH-OFFSET");
  EXPECT_EQ(iso("N4 X+0 Y+0 *\nN5 G27 R8 *\nN6 X+40 Y+0 *\n").alarm_id, "TNC-PATH-OFFSET");
  const auto goes_on = iso("N4 G41 X+0 Y+0 *\nN5 X+40 Y+0 *\nN6 G27 R2 *\nN7 X+40 Y+30 *\n");
  EXPECT_EQ(goes_on.alarm_id, "TNC-PATH-OFFSET");
  EXPECT_EQ(goes_on.alarm_line, 8u);
}
// HD-105: a block of M and F alone between RND and the next move does no harm; between the move
// and its RND it does.
TEST(TncCorner, BlocksWithoutCoordinatesAreNoElements) {
  EXPECT_THAT(moves_of({"L X+0 Y+10 R0 F100", "L X+0 Y+0", "L X+40 Y+0", "RND R5", "L R F M08",
                        "L X+40 Y+30"}),
              ElementsAre("L X0 Y10 F100", "L X0 Y0 F100", "L X35 Y0 F100",
                          "A X40 Y5 c35,5 ccw90 F100", "L X40 Y30 F100"));
  EXPECT_THAT(
      moves_of({"L X+0 Y+10 R0 F100", "L X+0 Y+0", "L R F M08", "RND R5", "L X+40 Y+0"}).back(),
      "! PLANE WRONGLY DEFINED");
  EXPECT_THAT(moves_of({"L X-10 Y+0 R0 F100", "L X+0 Y+0", "L R F M08", "CT X+10 Y+10"}).back(),
              "A X10 Y10 c0,10 ccw90 F100");
}
// HD-106: a corner whose second side is gone is reported.
TEST(TncCorner, AContourDoesNotEndBetweenTheSidesOfACorner) {
  const auto run =
      run_blocks({"TOOL DEF 1 L+0 R+4", "TOOL CALL 1 Z S100", "L X+0 Y+20 R0 F100", "L X+0 Y+0 RL",
                  "L X+40 Y+0", "RND R5", "TOOL CALL 0 Z S50", "L X+40 Y+30"});
  EXPECT_EQ(run.alarm_id, "TNC-PLANE");
  EXPECT_EQ(run.alarm_line, 9u);
}

// HD-108: the tool is within the circle.
TEST(TncCorner, ARunOnArcMustNotReachTheStart) {
  EXPECT_THAT(path("+4", {"L X+0 Y+10 R0 F100", "L X+0 Y+0 RL", "RND R8", "L X+40 Y+0"}).back(),
              "! ROUNDING RADIUS TOO LARGE");
}

// HD-110: from in front and the other side the arc would cut into the part.
TEST(TncCorner, QuadrantFourIsWarnedOf) {
  const auto warned = [](const std::string& start) {
    const auto run = run_blocks({"TOOL DEF 1 L+0 R+4", "TOOL CALL 1 Z S100", start, "L X+0 Y+0 RL",
                                 "RND R8", "L X+40 Y+0", "L X+40 Y+30 R0"});
    return std::count(run.events.begin(), run.events.end(), "warning TNC-QUADRANT");
  };
  EXPECT_EQ(warned("L X+30 Y-40 R0 F100"), 1);
  EXPECT_EQ(warned("L X-30 Y-40 R0 F100"), 0);
  EXPECT_EQ(warned("L X+30 Y+40 R0 F100"), 0);
  EXPECT_EQ(warned("L X-30 Y+40 R0 F100"), 0);
}

}  // namespace
}  // namespace dripline::interpreter
