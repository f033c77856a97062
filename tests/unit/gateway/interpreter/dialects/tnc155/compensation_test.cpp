#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> with_tool(const std::string& radius, std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(), {"TOOL DEF 1 L+0 R" + radius, "TOOL CALL 1 Z S100"});
  return blocks;
}
std::vector<std::string> path(const std::string& radius, const std::vector<std::string>& blocks) {
  return moves_of(with_tool(radius, blocks));
}

// HD-121, HD-123, HD-113: perpendicular to the first element, round the outside, off the last one.
TEST(TncCompensation, OutsideCornersGetATransitionalArc) {
  EXPECT_THAT(path("+5", {"L X+0 Y-20 R0 F100", "L X+0 Y+0 RR", "L X+40 Y+0", "L X+40 Y+30",
                          "L X+60 Y+30 R0"}),
              ElementsAre("L X0 Y-20 F100", "L X0 Y-5 F100", "L X40 Y-5 F100",
                          "A X45 Y0 c40,0 ccw90 F100", "L X45 Y30 F100", "L X60 Y30 F100"));
}

// HD-113: a block that leads to where the tool is begins the contour there: the tool goes to the
// perpendicular of the element after it, and no element is cut without the radius.
TEST(TncCompensation, AContourMayBeginWhereTheToolIs) {
  EXPECT_THAT(path("+5", {"L X+0 Y+0 R0 F100", "L X+0 Y+0 RR", "L X+40 Y+0", "L X+60 Y+0 R0"}),
              ElementsAre("L X0 Y-5 F100", "L X40 Y-5 F100", "L X60 Y0 F100"));
  EXPECT_THAT(path("+5", {"L X+10 Y+10 R0 F100", "L X+10 RL", "L X+40 Y+10", "L X+60 Y+10 R0"}),
              ElementsAre("L X10 Y10 F100", "L X10 Y15 F100", "L X40 Y15 F100", "L X60 Y10 F100"));
}

// HD-121, HD-122
TEST(TncCompensation, InsideCornersMeetWhereTheOffsetsDo) {
  EXPECT_THAT(path("+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "L X+40 Y+30",
                          "L X+20 Y+30 R0"}),
              ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X35 Y5 F100", "L X35 Y30 F100",
                          "L X20 Y30 F100"));
  // line and arc: y = 3 meets the circle of 10 + 3 about (40, 10) at x = 40 - sqrt(169 - 49)
  EXPECT_THAT(path("+3", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+30 Y+0", "L X+30 Y+10",
                          "CC X+40 Y+10", "C X+40 Y+20 DR-", "L X+60 Y+20", "L X+60 Y+40 R0"}),
              ElementsAre("L X0 Y20 F100", "L X0 Y3 F100", "L X27 Y3 F100", "L X27 Y10 F100",
                          "A X40 Y23 c40,10 cw90 F100", "L X60 Y23 F100", "L X60 Y40 F100"));
}

// HD-124: the step of 2 mm would be run backwards; nothing of it is done.
TEST(TncCompensation, AStepSmallerThanTheRadiusIsRefused) {
  const auto run = run_blocks(with_tool(
      "+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "L X+40 Y-2", "L X+80 Y-2"}));
  EXPECT_EQ(run.alarm_id, "TNC-TOOL-RADIUS");
  EXPECT_EQ(run.alarm_line, 7u);
  EXPECT_THAT(run.events.back(), HasSubstr("TOOL RADIUS TOO LARGE"));
}

// HD-117: with M97 the offsets go on to their intersection, and the step can be passed.
TEST(TncCompensation, M97TakesTheIntersectionAtAnOutsideCorner) {
  EXPECT_THAT(path("+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0 M97", "L X+40 Y-2",
                          "L X+80 Y-2", "L X+80 Y+20 R0"}),
              ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X45 Y5 F100", "L X45 Y3 F100",
                          "L X80 Y3 F100", "L X80 Y20 F100"));
}

// HD-117: after an arc M97 finds no intersection with the line; a line of no length helps: the
// corner of the tangents. Arc about (20, 0) from (0, 0) to (20, 20), clockwise; RL, 5: ends at
// (20, 25) along +X, then down: x = 25.
TEST(TncCompensation, ALineOfNoLengthGivesM97ATangent) {
  EXPECT_THAT(
      path("+5", {"L X+0 Y-40 R0 F100", "L X+0 Y-20 RL", "L X+0 Y+0", "CC X+20 Y+0",
                  "C X+20 Y+20 DR-", "L IX+0,000 IY+0,000 M97", "L X+20 Y-10", "L X+60 Y-10 R0"}),
      ElementsAre("L X0 Y-40 F100", "L X-5 Y-20 F100", "L X-5 Y0 F100", "A X20 Y25 c20,0 cw90 F100",
                  "L X25 Y25 F100", "L X25 Y-10 F100", "L X60 Y-10 F100"));
}

// HD-125: an arc of 4 cannot be run on its inside with a radius of 5.
TEST(TncCompensation, AnArcSmallerThanTheToolIsRefused) {
  EXPECT_THAT(path("+5", {"L X-30 Y+20 R0 F100", "L X-30 Y+0 RL", "L X+0 Y+0", "CC X+0 Y+4",
                          "C X+4 Y+4 DR+", "L X+4 Y+30"})
                  .back(),
              "! TOOL RADIUS TOO LARGE");
}

// HD-128
TEST(TncCompensation, AContourDoesNotBeginWithAnArc) {
  EXPECT_THAT(path("+5", {"L X+10 Y+0 R0 F100", "CC X+0 Y+0", "C X+0 Y+10 DR+ RL"}).back(),
              "! PATH OFFSET WRONGLY STARTED");
}

// HD-111: on the extension of the first element the path goes straight on; HD-112: from further
// out the first point is an outside corner.
TEST(TncCompensation, ApproachWithCompensationDependsOnTheAngle) {
  EXPECT_THAT(path("+5", {"L X-40 Y-20 R0 F100", "L X-20 Y+0 RL", "L X+0 Y+0", "L X+40 Y+0",
                          "L X+40 Y+20 R0"}),
              ElementsAre("L X-40 Y-20 F100", "L X-20 Y5 F100", "L X0 Y5 F100", "L X40 Y5 F100",
                          "L X40 Y20 F100"));
  EXPECT_THAT(path("+5", {"L X+0 Y-60 R0 F100", "L X+0 Y-40 RL", "L X+0 Y+0", "L X+40 Y+0",
                          "L X+40 Y+20 R0"}),
              ElementsAre("L X0 Y-60 F100", "L X-5 Y-40 F100", "L X-5 Y0 F100",
                          "A X0 Y5 c0,0 cw90 F100", "L X40 Y5 F100", "L X40 Y20 F100"));
}

// HD-115: with M96 PS counts as a point of the offset path: the tool touches the circle about P1 at
// 4 * (-0.6, 0.8) and goes round it.
TEST(TncCompensation, M96TakesTheStartAsCompensated) {
  EXPECT_THAT(
      path("+4", {"L X-20 Y-10 R0 F100", "L X+0 Y+0 RL M96", "L X+40 Y+0", "L X+40 Y+20 R0"}),
      ElementsAre("L X-20 Y-10 F100", "L X-2.4 Y3.2 F100", "A X0 Y4 c0,0 cw36.87 F100",
                  "L X40 Y4 F100", "L X40 Y20 F100"));
  // without it straight to P1k
  EXPECT_THAT(path("+4", {"L X-20 Y-10 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "L X+40 Y+20 R0"}),
              ElementsAre("L X-20 Y-10 F100", "L X0 Y4 F100", "L X40 Y4 F100", "L X40 Y20 F100"));
}

// HD-114: PS was programmed with compensation, and P1k is to be reached all the same.
TEST(TncCompensation, M95GoesStraightToTheFirstPoint) {
  EXPECT_THAT(path("+4", {"L X-40 Y+10 R0 F100", "L X-20 Y+10 RL", "L X+0 Y+0 M95", "L X+40 Y+0",
                          "L X+40 Y+20 R0"}),
              ElementsAre("L X-40 Y10 F100", "L X-20 Y10 F100", "L X0 Y4 F100", "L X40 Y4 F100",
                          "L X40 Y20 F100"));
  EXPECT_THAT(
      path("+4", {"L X-40 Y+10 R0 F100", "L X-20 Y+10 RL", "L X+0 Y+0", "L X+40 Y+0 M95"}).back(),
      "! PATH OFFSET WRONGLY STARTED");
  // for the first contour of the run only
  EXPECT_THAT(path("+4", {"L X-40 Y+30 R0 F100", "L X-60 Y+30 RL", "L X-40 Y+40 R0",
                          "L X-20 Y+10 RL", "L X+0 Y+0 M95", "L X+40 Y+0"})
                  .back(),
              "! PATH OFFSET WRONGLY STARTED");
}

// HD-116: the element ends complete, the next block keeps the offset (0, 4), and the contour that
// it begins starts with its own direction.
TEST(TncCompensation, M98EndsAContourCompletely) {
  EXPECT_THAT(path("+4", {"L X+0 Y+30 R0 F100", "L X+0 Y+0 RL", "L X+50 Y+0 M98", "L X+80 Y+20 RL",
                          "L X+80 Y+60", "L X+100 Y+60 R0"}),
              ElementsAre("L X0 Y30 F100", "L X0 Y4 F100", "L X50 Y4 F100", "L X80 Y24 F100",
                          "L X76 Y20 F100", "L X76 Y60 F100", "L X100 Y60 F100"));
}

// HD-116: milling line by line; both strokes lie on x = 20 + 3.
TEST(TncCompensation, LinesAreMilledToAndFro) {
  EXPECT_THAT(path("+3", {"L X+20 Y-10 RR F20", "L Y+110 M98", "L Z-20 R F9999", "L Y+110 RL F20",
                          "L Y-10 M98", "L Z+50 R0 F9999", "L X+0 Y+0"}),
              ElementsAre("L X23 Y-10 F20", "L X23 Y110 F20", "L X23 Y110 Z-20 F9999",
                          "L X23 Y-10 Z-20 F20", "L X23 Y-10 Z50 F9999", "L X0 Y0 Z50 F9999"));
}

// HD-126: a tool call ends the contour: the last element complete, then straight to the point.
TEST(TncCompensation, AToolCallEndsTheContour) {
  EXPECT_THAT(path("+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "TOOL CALL 0 Z S50",
                          "L X+40 Y+30"}),
              ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X40 Y5 F100", "L X40 Y30 F100"));
}

// HD-126: a datum shift ends it as M98 does. Whether the block after it keeps the offset of (0, 5),
// is on its own points or begins another contour is not stated: it names the side, or R0.
TEST(TncCompensation, ATransformationEndsTheContour) {
  const auto after_shift = [](const char* block) {
    return path("+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0",
                       "CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10", block, "L X+60 Y+30"});
  };
  EXPECT_THAT(after_shift("L X+40 Y+30 R0"),
              ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X40 Y5 F100", "L X50 Y30 F100",
                          "L X70 Y30 F100"));
  EXPECT_THAT(after_shift("L X+40 Y+30"),
              ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X40 Y5 F100",
                          "! PATH OFFSET WRONGLY STARTED"));
}

// HD-127: Z moves, calculations and labels between two elements; the next one may be in a
// subprogram. The Z move is made where the corner is.
TEST(TncCompensation, LookAheadGoesThroughOtherBlocks) {
  EXPECT_THAT(
      path("+5", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "L Z-5", "FN 0: Q1 = +30",
                  "CALL LBL 7 REP", "L X+20 Y+30 R0", "STOP M02", "LBL 7", "L X+40 Y+Q1", "LBL 0"}),
      ElementsAre("L X0 Y20 F100", "L X0 Y5 F100", "L X35 Y5 F100", "L X35 Y5 Z-5 F100",
                  "L X35 Y30 Z-5 F100", "L X20 Y30 Z-5 F100"));
}

std::vector<std::string> with_pecking(std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(),
                {"CYCL DEF 1.0 PECKING", "CYCL DEF 1.1 SET-UP-2", "CYCL DEF 1.2 DEPTH-4",
                 "CYCL DEF 1.3 PECKG-4", "CYCL DEF 1.4 DWELL 0", "CYCL DEF 1.5 F80"});
  return blocks;
}

// HD-127, HD-138: a hole in a contour is made at its corner, as a move along Z is, and the contour
// continues.
TEST(TncCompensation, AHoleIsMadeAtTheCorner) {
  EXPECT_THAT(
      path("+4", with_pecking({"L X+0 Y+20 Z+2 R0 F100 M03", "L X+0 Y+0 RL", "L X+50 Y+0 M99",
                               "L X+80 Y+0", "L X+80 Y+50 M99", "L X+60 Y+50 R0"})),
      ElementsAre("L X0 Y20 Z2 F100", "L X0 Y4 Z2 F100", "L X50 Y4 Z2 F100", "L X50 Y4 Z-4 F80",
                  "R X50 Y4 Z2", "L X76 Y4 Z2 F100", "L X76 Y50 Z2 F100", "L X76 Y50 Z-4 F80",
                  "R X76 Y50 Z2", "L X60 Y50 Z2 F100"));
}

// HD-127: one coordinate, R0 and an arc after a cycle find the contour's own points.
TEST(TncCompensation, ACycleLeavesTheProgrammedPointAlone) {
  EXPECT_THAT(path("+4", with_pecking({"L X+0 Y+20 Z+2 R0 F100 M03", "L X+0 Y+0 RL",
                                       "L X+50 Y+0 M99", "L X+80 R0", "L X+100"})),
              testing::Contains("L X100 Y0 Z2 F100"));
  EXPECT_EQ(path("+4", with_pecking({"L X+0 Y+20 Z+2 R0 F100 M03", "L X+0 Y+0 RL", "L X+50 Y+0 M99",
                                     "CC X+50 Y+20", "C X+70 Y+20 DR+", "L X+70 Y+40 R0"}))
                .back(),
            "L X70 Y40 Z2 F100");
}

// A pocket is milled where the block before ends by itself; the contour continues after it.
TEST(TncCompensation, APocketDoesNotEndTheContour) {
  const auto moves =
      path("+4", {"CYCL DEF 3.0 SLOT MILLING", "CYCL DEF 3.1 SET-UP-2", "CYCL DEF 3.2 DEPTH-4",
                  "CYCL DEF 3.3 PECKG-4 F80", "CYCL DEF 3.4 X+30", "CYCL DEF 3.5 Y+10",
                  "CYCL DEF 3.6 F100", "L X+0 Y+20 Z+2 R0 F100 M03", "L X+0 Y+0 RL",
                  "L X+50 Y+0 M99", "L X+80", "L X+80 Y+50", "L X+60 Y+50 R0"});
  ASSERT_GT(moves.size(), 10u);
  EXPECT_THAT(
      std::vector<std::string>(moves.end() - 4, moves.end()),
      ElementsAre("R X50 Y4 Z2", "L X76 Y4 Z2 F100", "L X76 Y50 Z2 F100", "L X60 Y50 Z2 F100"));
}

// HD-127: a hole whose moves would not fit at the corner is refused before it is begun.
TEST(TncCompensation, AHoleOfVeryManyPecksIsNotMadeInAContour) {
  const auto with_pecks = [](const std::string& peck, const std::string& first) {
    return path("+4", {"CYCL DEF 1.0 PECKING", "CYCL DEF 1.1 SET-UP-2", "CYCL DEF 1.2 DEPTH-20",
                       "CYCL DEF 1.3 PECKG-" + peck, "CYCL DEF 1.4 DWELL 0", "CYCL DEF 1.5 F80",
                       "L X+0 Y+20 Z+2 R0 F100 M03", first, "L X+50 Y+0 M99", "L X+80 Y+0",
                       "L X+80 Y+50 R0"})
        .back();
  };
  EXPECT_EQ(with_pecks("0,2", "L X+0 Y+0 RL"), "! ENTRY VALUE INCORRECT");
  EXPECT_EQ(with_pecks("0,3", "L X+0 Y+0 RL"), "L X80 Y50 Z2 F100");
  EXPECT_EQ(with_pecks("0,2", "L X+0 Y+0 R0"), "L X80 Y50 Z2 F100");
}

// HD-127: a pocket before the first block in the plane leaves the start-up to that block.
TEST(TncCompensation, APocketBeforeTheFirstBlockLeavesTheStartUpToIt) {
  const auto moves =
      path("+3", {"CYCL DEF 5.0 CIRCULAR POCKET", "CYCL DEF 5.1 SET-UP-2", "CYCL DEF 5.2 DEPTH-5",
                  "CYCL DEF 5.3 PECKG-5 F100", "CYCL DEF 5.4 RADIUS 10", "CYCL DEF 5.5 F200 DR+",
                  "L X+0 Y+0 R0 F9999 M03", "L Z+2", "L RL F200", "CYCL CALL", "L X+30 Y+0",
                  "L X+30 Y+30", "L X+60 Y+60 R0"});
  ASSERT_GT(moves.size(), 8u);
  EXPECT_THAT(std::vector<std::string>(moves.end() - 3, moves.end()),
              ElementsAre("L X27 Y0 Z2 F200", "L X27 Y30 Z2 F200", "L X60 Y60 Z2 F200"));
}

// HD-184: a rotation of another plane rotates the hole's path into the plane of the contour.
TEST(TncCompensation, AHoleUnderARotationOfAnotherPlaneIsNoElement) {
  const auto moves =
      path("+3", with_pecking({"TOOL CALL Y", "CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT+30",
                               "TOOL CALL Z", "L X-20 Y+0 Z+2 R0 F9999 M03", "L X+0 Y+0 RL F200",
                               "L X+30 Y+0 M99", "L X+30 Y+30", "L X+60 Y+60 R0"}));
  for (const std::string& move : moves) {
    EXPECT_FALSE(move.starts_with("A")) << move;
    EXPECT_EQ(move.find("Y-"), std::string::npos) << move;
  }
}

// HD-089: cycles along a rotary axis feed in degrees.
TEST(TncCompensation, AHoleAlongARotaryAxisHasItsFeed) {
  const auto moves = moves_of(with_pecking(
      {"TOOL DEF 1 L+0 R+4", "TOOL CALL 1 IV S100", "L X+0 Y+0 C+2 R0 F100 M03", "CYCL CALL"}));
  ASSERT_GE(moves.size(), 2u);
  EXPECT_NE(moves[1].find(" F80"), std::string::npos) << moves[1];
}

// HD-093: R+ and R- are only allowed between blocks with R0, along the tool axis as well.
TEST(TncCompensation, ASingleAxisOffsetIsNoPartOfAContour) {
  EXPECT_EQ(path("+4", {"L X+0 Y+20 Z+0 R0 F100", "L X+0 Y+0 RL", "L X+50 Y+0", "Z+5 R+"}).back(),
            "! PATH OFFSET WRONGLY STARTED");
  EXPECT_EQ(
      path("+4", {"L X+0 Y+20 Z+0 R0 F100", "L X+0 Y+0 RL", "L X+50 Y+0 M98", "X+60 R-"}).back(),
      "! PATH OFFSET WRONGLY STARTED");
}

// HD-123: rapid traverse is a large feed, and goes round a corner as any other.
TEST(TncCompensation, ARapidElementGetsATransitionalArc) {
  EXPECT_THAT(path("+5", {"L X+0 Y-20 R0 F100", "L X+0 Y+0 RR", "L X+40 Y+0 F MAX",
                          "L X+40 Y+30 F MAX", "L X+60 Y+30 R0 F100"}),
              ElementsAre("L X0 Y-20 F100", "L X0 Y-5 F100", "R X40 Y-5",
                          "A X45 Y0 c40,0 ccw90 F15999", "R X45 Y30", "L X60 Y30 F100"));
}

// HD-127: any number of moves along the tool axis may stand at a corner.
TEST(TncCompensation, ManyMovesAlongZStandAtACorner) {
  std::vector<std::string> blocks = {"L X+0 Y+20 Z+0 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0"};
  for (int i = 1; i <= 200; ++i) blocks.push_back("L Z-" + std::to_string(i));
  blocks.insert(blocks.end(), {"L X+40 Y+30", "L X+20 Y+30 R0"});
  const auto moves = path("+5", blocks);
  ASSERT_EQ(moves.size(), 205u);
  EXPECT_EQ(moves[2], "L X35 Y5 Z0 F100");
  EXPECT_EQ(moves[202], "L X35 Y5 Z-200 F100");
}

// HD-124: the last moves of a contour are looked at where the text ends without END PGM as well.
TEST(TncCompensation, TheEndOfTheTextEndsAContour) {
  const std::string text =
      "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S 500\n3 L X+0 Y+20 R0 F900\n"
      "4 L X+0 Y+0 RL\n5 L X+40 Y-2\n6 L X+40 Y+0\n";
  for (const char* end : {"", "7 END PGM 1 MM\n"}) {
    const auto run = run_text(text + end);
    EXPECT_EQ(run.alarm_id, "TNC-TOOL-RADIUS") << end;
    EXPECT_EQ(run.alarm_line, 7u) << end;
  }
}

// HD-131: a negative radius goes to the other side.
TEST(TncCompensation, ANegativeRadiusSwapsTheSide) {
  EXPECT_THAT(path("-2", {"L X+0 Y+20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "L X+40 Y+30 R0"}),
              ElementsAre("L X0 Y20 F100", "L X0 Y-2 F100", "L X40 Y-2 F100", "L X40 Y30 F100"));
}

// HD-104: upwards and counterclockwise, RL: an internal right-hand thread; radius 10 - 2.
TEST(TncCompensation, AHelixIsOffsetAsItsCircle) {
  EXPECT_THAT(path("+2", {"L X+0 Y+0 Z+0 R0 F100", "CC X+0 Y+0", "L X+10 Y-5 RL", "L X+10 Y+0",
                          "CP IPA+720 IZ+6 DR+ RL", "L X+10 Y+5", "L X+0 Y+0 R0"}),
              ElementsAre("L X8 Y-5 Z0 F100", "L X8 Y0 Z0 F100", "A X8 Y0 Z6 c0,0 ccw720 F100",
                          "L X8 Y5 Z6 F100", "L X0 Y0 Z6 F100"));
}

}  // namespace
}  // namespace dripline::interpreter
