#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

// HD-088: up to three axes start and end together; what is not named stays.
TEST(TncMotion, StraightBlocksMoveUpToThreeAxes) {
  EXPECT_THAT(moves_of({"L X+10 Y+20 Z-5 R0 F100 M", "L IX+5 R F M", "L Y-2,5 Z+0"}),
              ElementsAre("L X10 Y20 Z-5 F100", "L X15 Y20 Z-5 F100", "L X15 Y-2.5 Z0 F100"));
}

// HD-089, HD-092, HD-238: F of linear and rotary axes together is that of the whole path: 30 mm and
// 40 degrees are 50, so the linear axes have 100 * 30 / 50. Older software: F is the rotary
// axis's, so 100 * 30 / 40.
TEST(TncMotion, RotaryAxesShareTheFeed) {
  EXPECT_THAT(moves_of({"L X+30 C+40 R0 F100"}), ElementsAre("L X30 C40 F60"));
  EXPECT_THAT(moves_of({"L X+30 C+40 R0 F100"}, {"[control]\nrotary_feed = \"rotary\"", {}}),
              ElementsAre("L X30 C40 F75"));
  EXPECT_THAT(moves_of({"L C+90 R0 F200"}), ElementsAre("L C90 F200"));
}

// HD-090, HD-091: F15999 is a feed; F MAX is rapid for its block only.
TEST(TncMotion, FeedsStayUntilChanged) {
  EXPECT_THAT(moves_of({"L X+1 R0 F15999", "L X+2 F MAX", "L X+3", "L X+4 F50"}),
              ElementsAre("L X1 F15999", "R X2", "L X3 F15999", "L X4 F50"));
  EXPECT_THAT(moves_of({"L X+1 R0"}), ElementsAre("! FEED RATE MISSING"));
  EXPECT_THAT(moves_of({"FN 0: Q1 = +16000", "L X+1 R0 FQ1"}),
              ElementsAre("! ENTRY VALUE INCORRECT"));
}

// HD-058, HD-059: inch programs count F in tenths of an inch: F250 is 25 inch/min, 635 mm/min.
TEST(TncMotion, InchProgramsHaveInchesAndTenthsOfAnInchPerMinute) {
  PathSetup inch;
  inch.units = "INCH";
  EXPECT_THAT(moves_of({"L X+1 Y-0,5 R0 F250"}, inch), ElementsAre("L X25.4 Y-12.7 F635"));
}

// HD-058, HD-059, HD-092: F is tenths of an inch of linear axes, degrees of a rotary axis, by the
// block that uses it: F100 is 10 inch/min, 254 mm/min.
TEST(TncMotion, FeedsOfInchProgramsCountByWhatMoves) {
  PathSetup inch;
  inch.units = "INCH";
  EXPECT_THAT(moves_of({"L X+1 C+0 R0 F100", "L C+90 F100", "L X+2"}, inch),
              ElementsAre("L X25.4 C0 F254", "L X25.4 C90 F100", "L X50.8 C90 F254"));
  EXPECT_THAT(
      moves_of({"L X+1 R0 F250", "L C+90", "C+180", "L X+2"}, inch),
      ElementsAre("L X25.4 F635", "L X25.4 C90 F250", "L X25.4 C180 F250", "L X50.8 C180 F635"));
  // a program that is called keeps what F meant where it was programmed
  EXPECT_THAT(moves_of({"L X+1 R0 F100", "CALL PGM 7", "L X+3"},
                       {"", {{"7", "0 BEGIN PGM 7 INCH\n1 L C+90\n2 END PGM 7 INCH\n"}}, "MM"}),
              ElementsAre("L X1 F100", "L X1 C90 F100", "L X3 C90 F100"));
}

// HD-089: with F of the rotary axis (older software), that is degrees: 100 * 25.4 / 90.
TEST(TncMotion, TheRotaryAxisOfAnInchProgramSharesItsDegrees) {
  PathSetup inch{"[control]\nrotary_feed = \"rotary\"", {}, "INCH"};
  EXPECT_THAT(moves_of({"L X+1 C+90 R0 F100"}, inch), ElementsAre("L X25.4 C90 F28.222"));
}

const std::vector<std::string> kTool5{"TOOL DEF 1 L+0 R+5", "TOOL CALL 1 Z S100"};

std::vector<std::string> with_tool5(std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(), kTool5.begin(), kTool5.end());
  return blocks;
}

// HD-093, HD-132: R+ makes the travel of one axis longer by the tool radius, R- shorter.
TEST(TncMotion, SingleAxisBlocksAddTheRadiusAlongTheTravel) {
  EXPECT_THAT(moves_of(with_tool5({"X+10 R0 F100", "X+40 R+", "X+10 R0", "X+40 R-"})),
              ElementsAre("L X10 F100", "L X45 F100", "L X10 F100", "L X35 F100"));
  EXPECT_THAT(moves_of(with_tool5({"X+50 R0 F100", "X+40 R+"})),
              ElementsAre("L X50 F100", "L X35 F100"));
  // incremental words count from the programmed point: 40 + 20
  EXPECT_THAT(moves_of(with_tool5({"X+40 R+ F100", "IX+20 R0"})),
              ElementsAre("L X45 F100", "L X60 F100"));
  // not in the tool axis
  EXPECT_THAT(moves_of(with_tool5({"Z-10 R+ F100"})), ElementsAre("L Z-10 F100"));
}

// HD-093, HD-183: tool data are not scaled, mirrored or not.
TEST(TncMotion, SingleAxisBlocksAddTheRadiusUnscaled) {
  const std::vector<std::string> scaled{"CYCL DEF 11.0 SCALING", "CYCL DEF 11.1 SCL 2"};
  const auto with = [&](const std::string& radius, const std::vector<std::string>& before,
                        const std::vector<std::string>& blocks) {
    std::vector<std::string> all{"TOOL DEF 1 L+0 R" + radius, "TOOL CALL 1 Z S100"};
    all.insert(all.end(), scaled.begin(), scaled.end());
    all.insert(all.end(), before.begin(), before.end());
    all.insert(all.end(), blocks.begin(), blocks.end());
    return moves_of(all);
  };
  EXPECT_THAT(with("+5", {}, {"L X+10 Y+0 R0 F100", "X+40 R+", "X+0 R-"}),
              ElementsAre("L X20 Y0 F100", "L X85 Y0 F100", "L X5 Y0 F100"));
  EXPECT_THAT(with("+2", {"CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X"},
                   {"L X+10 Y+0 R0 F100", "X+30 R+"}),
              ElementsAre("L X-20 Y0 F100", "L X-62 Y0 F100"));
}

// HD-093: R+ and RL must not follow each other.
TEST(TncMotion, SingleAxisRadiusDoesNotMeetAContour) {
  EXPECT_THAT(moves_of(with_tool5({"X+40 R+ F100", "L X+50 Y+5 RL"})),
              ElementsAre("L X45 F100", "! PATH OFFSET WRONGLY STARTED"));
  EXPECT_THAT(
      moves_of(with_tool5({"L X+0 Y-20 R0 F100", "L X+0 Y+0 RL", "L X+40 Y+0", "X+60 R+"})).back(),
      "! PATH OFFSET WRONGLY STARTED");
}

// HD-094, HD-096: (10 + 20 cos 30, 10 + 20 sin 30), then 25 at 90 degrees.
TEST(TncMotion, PolarLinesGoFromThePole) {
  EXPECT_THAT(moves_of({"CC X+10 Y+10", "LP PR+20 PA+30 R0 F100", "LP IPR+5 IPA+60"}),
              ElementsAre("L X27.321 Y20 F100", "L X10 Y35 F100"));
  // a word that is left out stays
  EXPECT_THAT(moves_of({"CC X+0 Y+0", "LP PR+10 PA+0 R0 F100", "LP PA+90", "LP PR+4"}),
              ElementsAre("L X10 Y0 F100", "L X0 Y10 F100", "L X0 Y4 F100"));
  // after a Cartesian block the present place counts: (6, 8) is 10 at 53.130 degrees
  EXPECT_THAT(moves_of({"CC X+0 Y+0", "LP PR+5 PA+0 R0 F100", "L X+6 Y+8", "LP IPR+10 IPA+0"}),
              ElementsAre("L X5 Y0 F100", "L X6 Y8 F100", "L X12 Y16 F100"));
  EXPECT_THAT(moves_of({"CC X+0 Y+0", "LP PR+5 R0 F100"}),
              ElementsAre("! ANGLE REFERENCE MISSING"));
}

// HD-096: on the pole the radius is 0, and only an angle that counts from the last one is missing.
TEST(TncMotion, PolarLinesLeaveThePoleByAnAngle) {
  const std::vector<std::string> start{"CC X+0 Y+0", "LP PR+5 PA+0 R0 F100", "CC"};
  const auto after = [&](const std::string& block) {
    std::vector<std::string> blocks = start;
    blocks.push_back(block);
    return moves_of(blocks).back();
  };
  EXPECT_EQ(after("LP IPR+10 PA+90"), "L X5 Y10 F100");
  EXPECT_EQ(after("LP PA+90"), "L X5 Y0 F100");
  EXPECT_EQ(after("LP IPR+10 IPA+90"), "! ANGLE REFERENCE MISSING");
  EXPECT_EQ(after("LP PR+10"), "! ANGLE REFERENCE MISSING");
}

// HD-095: CC without words, and with one.
TEST(TncMotion, ThePoleTakesOverTheLastPosition) {
  EXPECT_THAT(moves_of({"L X+20 Y+30 R0 F100", "CC", "LP PR+5 PA+90"}),
              ElementsAre("L X20 Y30 F100", "L X20 Y35 F100"));
  EXPECT_THAT(moves_of({"L X+20 Y+30 R0 F100", "CC X+5", "LP PR+10 PA+0"}),
              ElementsAre("L X20 Y30 F100", "L X15 Y30 F100"));
  EXPECT_THAT(moves_of({"L X+20 Y+30 R0 F100", "CC IX-20 Y+0", "LP PR+10 PA+180"}),
              ElementsAre("L X20 Y30 F100", "L X-10 Y0 F100"));
}

// HD-097, HD-099: about CC in the direction of DR; back to the start is a full circle.
TEST(TncMotion, ArcsTurnAboutTheirCenter) {
  const std::string start = "L X+10 Y+0 R0 F100";
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "C X+0 Y+10 DR+ R0 F M"}),
              ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 ccw90 F100"));
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "C X+0 Y+10 DR-"}),
              ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 cw270 F100"));
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "C X+10 Y+0 DR-"}),
              ElementsAre("L X10 Y0 F100", "A X10 Y0 c0,0 cw360 F100"));
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "C X+0 Y+10,016 DR+"}).back(),
              "A X0 Y10.016 c0,0 ccw90 F100");
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "C X+0 Y+10,017 DR+"}).back(),
              "! CIRCLE END POS. INCORRECT");
}

// HD-090, HD-097: an arc is never a rapid move, so F MAX is the highest feed there is, for its
// block.
TEST(TncMotion, ArcsTakeTheHighestFeedForRapid) {
  EXPECT_THAT(
      moves_of({"L X+10 Y+0 R0 F MAX", "CC X+0 Y+0", "C X-10 Y+0 DR+ F MAX", "CP PA+0 DR+"}),
      ElementsAre("R X10 Y0", "A X-10 Y0 c0,0 ccw180 F15999", "! FEED RATE MISSING"));
  EXPECT_THAT(moves_of({"L X+10 Y+0 R0 F100", "CC X+0 Y+0", "CP PA+180 DR+ F MAX", "CP PA+0 DR+",
                        "CT X+0 Y+0 F MAX"}),
              ElementsAre("L X10 Y0 F100", "A X-10 Y0 c0,0 ccw180 F15999",
                          "A X10 Y0 c0,0 ccw180 F100", "A X0 Y0 c5,0 ccw180 F15999"));
}

// HD-097: in the other planes. Y tools work in ZX: from +Z (second 0) to +X.
TEST(TncMotion, ArcsLieInThePlaneOfTheTool) {
  EXPECT_THAT(
      moves_of({"TOOL CALL 0 Y S100", "L X+0 Z+10 R0 F100", "CC X+0 Z+0", "C X+10 Z+0 DR+"}),
      ElementsAre("L X0 Z10 F100", "A X10 Z0 c0,0 ccw90 F100"));
}

// HD-098, HD-100: with a sign against DR the angle only says where it ends.
TEST(TncMotion, PolarArcsKeepTheirRadius) {
  const std::string start = "L X+10 Y+0 R0 F100";
  EXPECT_THAT(
      moves_of({start, "CC X+0 Y+0", "CP PA+90 DR+", "CP IPA+90 DR+"}),
      ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 ccw90 F100", "A X-10 Y0 c0,0 ccw90 F100"));
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "CP IPA-90 DR+"}).back(),
              "A X0 Y-10 c0,0 ccw270 F100");
  EXPECT_THAT(moves_of({start, "CC X+0 Y+0", "CP PA+0 DR-"}).back(), "A X10 Y0 c0,0 cw360 F100");
  EXPECT_THAT(moves_of({start, "CC X+10 Y+0", "CP PA+90 DR+"}).back(), "! ANGLE REFERENCE MISSING");
}

// HD-103, HD-014: two and a half revolutions, 2 mm each.
TEST(TncMotion, AHelixIsAPolarArcThatRises) {
  EXPECT_THAT(moves_of({"L X+10 Y+0 R0 F100", "CC X+0 Y+0", "CP IPA+900 IZ+5 DR+ R0 F"}),
              ElementsAre("L X10 Y0 F100", "A X-10 Y0 Z5 c0,0 ccw900 F100"));
}

// HD-101: from (0, 0) along +X to (10, 10): center (0, 10). After an arc its tangent counts.
TEST(TncMotion, TangentialArcsGoOnWhereTheElementBeforeEnds) {
  EXPECT_THAT(moves_of({"L X-10 Y+0 R0 F100", "L X+0 Y+0", "CT X+10 Y+10"}),
              ElementsAre("L X-10 Y0 F100", "L X0 Y0 F100", "A X10 Y10 c0,10 ccw90 F100"));
  EXPECT_THAT(
      moves_of({"L X+10 Y+0 R0 F100", "CC X+0 Y+0", "C X+0 Y+10 DR+", "CT X-10 Y+20"}),
      ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 ccw90 F100", "A X-10 Y20 c0,20 cw90 F100"));
  // ahead on the tangent: straight
  EXPECT_THAT(moves_of({"L X-10 Y+0 R0 F100", "L X+0 Y+0", "CT X+10 Y+0"}).back(), "L X10 Y0 F100");
}

// HD-102
TEST(TncMotion, TangentialArcsNeedAnElementBeforeThem) {
  EXPECT_THAT(moves_of({"CT X+10 Y+10 R0 F100"}), ElementsAre("! CIRCLE END POS. INCORRECT"));
  EXPECT_THAT(moves_of({"L X+5 R0 F100", "CT X+10 Y+10"}).back(), "! ANGLE REFERENCE MISSING");
  EXPECT_THAT(moves_of({"L X-10 Y+0 R0 F100", "L X+0 Y+0", "CT X-5 Y+0"}).back(),
              "! CIRCLE END POS. INCORRECT");
}

// HD-119: M91 counts from the reference point, M92 from a point of the machine builder's.
TEST(TncMotion, MachineCoordinatesLeaveTheDatumOut) {
  const PathSetup datum{
      "[[offset]]\nname = \"datum\"\nX = 100\nZ = 20\n"
      "[control]\nm92_position = { Z = 300 }",
      {}};
  EXPECT_THAT(
      moves_of({"L X+5 Z+1 R0 F100", "L Z+7 F MAX M91", "L Z+7 F MAX M92", "L IZ-7"}, datum),
      ElementsAre("L X105 Z21 F100", "R X105 Z7", "R X105 Z307", "L X105 Z300 F100"));
}

// HD-119: the end of an arc in machine coordinates, the center where CC is: (100, 0) in the
// machine.
TEST(TncMotion, ArcsMayEndInMachineCoordinates) {
  const PathSetup datum{"[[offset]]\nname = \"datum\"\nX = 100", {}};
  EXPECT_THAT(
      moves_of({"L X+10 Y+0 R0 F100", "CC X+0 Y+0", "C X+100 Y+10 DR+ M91", "L X+5"}, datum),
      ElementsAre("L X110 Y0 F100", "A X100 Y10 c100,0 ccw90 F100", "L X105 Y10 F100"));
  EXPECT_THAT(moves_of({"L X-10 Y+0 R0 F100", "L X+0 Y+0", "CT X+110 Y+10 M91"}, datum).back(),
              "A X110 Y10 c100,10 ccw90 F100");
}

// HD-119: turned by 90 degrees, X of the machine is the program's -Y.
TEST(TncMotion, MachineCoordinatesOfAnArcAreNotTurned) {
  EXPECT_THAT(moves_of({"CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT+90", "L X+10 Y+0 R0 F100",
                        "CC X+0 Y+0", "C X-10 Y+0 DR+ M91", "L X+0 Y+0"}),
              ElementsAre("L X0 Y10 F100", "A X-10 Y0 c0,0 ccw90 F100", "L X0 Y0 F100"));
}

// HD-119: what M91 and M92 cannot be for is refused, never left out.
TEST(TncMotion, MachineCoordinatesAreForCartesianMovesWithoutARadius) {
  for (const char* block :
       {"LP PR+10 PA+0 M91", "CP PA+90 DR+ M92", "L R F M91", "STOP M91", "CYCL CALL M92"}) {
    EXPECT_THAT(moves_of({"L X+10 Y+0 R0 F100", "CC X+0 Y+0", block}),
                ElementsAre("L X10 Y0 F100", "! BLOCK FORMAT INCORRECT"))
        << block;
  }
  EXPECT_THAT(run_text("%3 G71 *\nN1 G17 G40 G90 G01 X+1 F100 *\nN2 I+0 J+0 M91 *\n").events.back(),
              testing::StartsWith("! BLOCK FORMAT INCORRECT"));
  EXPECT_THAT(moves_of({"L X+10 Y+0 R0 F100", "L X+0 RL M91"}).back(),
              "! PATH OFFSET WRONGLY STARTED");
  EXPECT_THAT(moves_of({"L X+10 Y+0 R0 F100", "CC X+0 Y+0", "C X+0 Y+10 DR+ RL M91"}).back(),
              "! PATH OFFSET WRONGLY STARTED");
}

// HD-120: whole revolutions are subtracted from the program's value; the axis stays where it was,
// so that 40 is 10 further than 750.
TEST(TncMotion, M94TakesWholeTurnsOffARotaryAxis) {
  EXPECT_THAT(moves_of({"L C+750 R0 F100", "L IC+10 M94", "L C+20"}),
              ElementsAre("L C750 F100", "L C760 F100", "L C740 F100"));
  EXPECT_THAT(moves_of({"L C-400 R0 F100", "C+0 M94"}),
              ElementsAre("L C-400 F100", "L C-360 F100"));
}

// HD-161: Q in coordinates, feeds, radii and angles; HD-160: with its sign.
TEST(TncMotion, ParametersStandForNumbers) {
  EXPECT_THAT(moves_of({"FN 0: Q1 = +40", "FN 0: Q2 = +19", "FN 0: Q3 = +150", "L X+Q1 Y-Q2 R0 FQ3",
                        "CC X+0 Y+0", "FN 0: Q4 = +90", "LP PR+Q2 PA-Q4"}),
              ElementsAre("L X40 Y-19 F150", "L X0 Y-19 F150"));
}

// HD-031, HD-012: the pole lies in the working plane.
TEST(TncMotion, TheWordsOfThePoleBelongToThePlane) {
  const auto iso = [](const std::string& plane, const std::string& pole) {
    return run_text("%3 G71 *\nN10 " + plane + " G00 G40 G90 X+10 Y+10 Z+10 *\nN20 " + pole +
                    " *\nN30 G10 R+5 H+0 *\nN9999 %3 G71 *\n");
  };
  for (const auto& [plane, right, wrong, end] :
       {std::tuple{"G17", "I+0 J+0", "I+0 K+0", "R X5 Y0 Z10"},
        std::tuple{"G18", "I+0 K+0", "I+0 J+0", "R X0 Y10 Z5"},
        std::tuple{"G19", "J+0 K+0", "I+0", "R X10 Y5 Z0"}}) {
    EXPECT_EQ(iso(plane, right).events.at(1), end);
    const auto refused = iso(plane, wrong);
    EXPECT_EQ(refused.alarm_id, "TNC-PLANE") << plane;
    EXPECT_EQ(refused.alarm_line, 3u) << plane;
  }
  EXPECT_THAT(iso("G17", "K+0").events,
              ElementsAre("R X10 Y10 Z10",
                          "! PLANE WRONGLY DEFINED: the pole is in the working plane XY, which has "
                          "no Z"));
  EXPECT_THAT(moves_of({"TOOL CALL 0 Z", "CC X+0 Z+0"}), ElementsAre("! PLANE WRONGLY DEFINED"));
  EXPECT_THAT(moves_of({"TOOL CALL 0 Y", "CC X+0 Z+0"}), ElementsAre());
}

// HD-092, HD-059: degrees have their range and their step in inch programs as well.
TEST(TncMotion, DegreesOfInchProgramsAreThoseOfAllPrograms) {
  PathSetup inch;
  inch.units = "INCH";
  EXPECT_THAT(moves_of({"L C+2000,125 R0 F MAX"}, inch), ElementsAre("R C2000.125"));
  EXPECT_THAT(moves_of({"L IC-30000 R0 F MAX"}, inch), ElementsAre("R C-30000"));
  EXPECT_EQ(run_blocks({"L C+30000,001 R0 F MAX"}, inch).alarm_id, "TNC-ENTRY-RANGE");
  EXPECT_THAT(run_blocks({"L C+20,1234 R0 F MAX"}, inch).events,
              ElementsAre("! ENTRY VALUE INCORRECT: C +20,1234 has more than 3 decimals"));
  EXPECT_THAT(moves_of({"L C+20,1230 R0 F MAX"}, inch), ElementsAre("R C20.123"));
  EXPECT_EQ(run_blocks({"L X+2000 R0 F MAX"}, inch).alarm_id, "TNC-ENTRY-RANGE");
  const std::string iso = "%3 G70 *\nN10 G17 G00 G40 G90 ";
  EXPECT_THAT(run_text(iso + "C+2000 *\n").events,
              ElementsAre("R C2000", testing::StartsWith("end")));
  EXPECT_EQ(run_text(iso + "C+0,0001 *\n").alarm_id, "TNC-ENTRY-RANGE");
}

// HD-088: the machine has one axis IV.
TEST(TncMotion, AxesThatTheMachineHasNotAreRefused) {
  const PathSetup turning{"[control]\nfourth_axis = \"A\"", {}};
  EXPECT_THAT(moves_of({"L A+5 R0 F MAX", "L X+1 C+5"}, turning),
              ElementsAre("R A5", "! WRONG AXIS PROGRAMMED"));
  EXPECT_THAT(
      run_blocks({"L C+5 R0 F MAX", "W+5 F MAX"}).events,
      ElementsAre("R C5",
                  "! WRONG AXIS PROGRAMMED: W: axis IV of this machine is C (fourth_axis)"));
  EXPECT_THAT(moves_of({"TOOL CALL 0 U"}), ElementsAre("! WRONG AXIS PROGRAMMED"));
  EXPECT_THAT(moves_of({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 V+5"}),
              ElementsAre("! WRONG AXIS PROGRAMMED"));
}

}  // namespace
}  // namespace dripline::interpreter
