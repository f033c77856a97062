#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

const std::string kStart = "L X+10 Y+0 R0 F100";
const std::string kPole = "CC X+0 Y+0";

// HD-097, HD-103: a circle lies in the plane of the tool; only CP moves the tool axis besides.
TEST(TncCircle, OtherAxesThanThePlanesAreRefused) {
  for (const char* block : {"C X-10 Z+5 DR+", "C X-10 C+5 DR+", "C Z+5 DR+", "C IX-20 IZ+5 DR-",
                            "CP PA+90 C+99 DR+", "CP PA+90 X+99 DR+", "CP IPA+90 IY+1 DR+"}) {
    EXPECT_THAT(moves_of({kStart, kPole, block}),
                ElementsAre("L X10 Y0 F100", "! PLANE WRONGLY DEFINED"))
        << block;
  }
  EXPECT_EQ(run_text("%3 G71 *\nN1 G17 G40 G90 G01 X+10 Y+0 F100 *\nN2 I+0 J+0 *\n"
                     "N3 G02 X-10 Z+5 *\n")
                .alarm_id,
            "TNC-PLANE");
  EXPECT_THAT(
      moves_of({"TOOL CALL 0 X S100", "L Y+10 Z+0 R0 F100", "CC Y+0 Z+0", "CP IPA+90 IX+4 DR+",
                "CP IPA+90 IZ+4 DR+"}),
      ElementsAre("L Y10 Z0 F100", "A X4 Y0 Z10 c0,0 ccw90 F100", "! PLANE WRONGLY DEFINED"));
}

// HD-103: an axis parallel to that of the plane, where the tool is in it.
TEST(TncCircle, AHelixMovesTheToolAxis) {
  const PathSetup fourth{"[control]\nfourth_axis = \"W\"", {}};
  const std::vector<std::string> helix{kStart, kPole, "CP IPA+90 IW+4 DR+"};
  std::vector<std::string> called{"TOOL CALL 0 IV S100"};
  called.insert(called.end(), helix.begin(), helix.end());
  EXPECT_EQ(moves_of(called, fourth).back(), "A X0 Y10 W4 c0,0 ccw90 F100");
  EXPECT_EQ(moves_of(helix, fourth).back(), "! PLANE WRONGLY DEFINED");
}

// HD-100, HD-103: the rest of IPA+0 is none, and so are its full revolutions.
TEST(TncCircle, AHelixWithoutTurnsMovesTheToolAxisAlone) {
  EXPECT_THAT(moves_of({kStart, kPole, "CP IPA+0 IZ+5 DR+", "CP IPA+90 DR+"}),
              ElementsAre("L X10 Y0 F100", "L X10 Y0 Z5 F100", "A X0 Y10 Z5 c0,0 ccw90 F100"));
  EXPECT_THAT(moves_of({kStart, kPole, "CP IPA+0 DR-", "CP IPA+90 DR+"}),
              ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 ccw90 F100"));
  EXPECT_THAT(
      moves_of({kStart, kPole, "CP IPA+360 IZ+5 DR-", "CP PA+0 DR-"}),
      ElementsAre("L X10 Y0 F100", "A X10 Y0 Z5 c0,0 cw360 F100", "A X10 Y0 Z5 c0,0 cw360 F100"));
  EXPECT_THAT(moves_of({kStart, "CC X+10 Y+0", "CP IPA+0 DR+"}).back(),
              "! ANGLE REFERENCE MISSING");
}

// HD-101, HD-184: the path before stays where it was in the machine, whatever coordinates count
// now.
TEST(TncCircle, TangentsOutlastATransformation) {
  const auto with = [](std::vector<std::string> cycle, const std::string& tangent) {
    std::vector<std::string> blocks{"L X+0 Y+0 R0 F100", "L X+10 Y+0"};
    blocks.insert(blocks.end(), cycle.begin(), cycle.end());
    blocks.push_back(tangent);
    return moves_of(blocks).back();
  };
  const std::string quarter = "A X20 Y10 c10,10 ccw90 F100";
  EXPECT_EQ(with({"CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X"}, "CT X-20 Y+10"), quarter);
  EXPECT_EQ(with({"CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT+90"}, "CT X+10 Y-20"), quarter);
  EXPECT_EQ(with({"CYCL DEF 11.0 SCALING", "CYCL DEF 11.1 SCL 2"}, "CT X+10 Y+5"), quarter);
  EXPECT_EQ(with({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+5"}, "CT X+15 Y+10"), quarter);
}

// HD-101, HD-179: of an arc the center counts and its turn in the machine: to the left at (0, 10).
TEST(TncCircle, TangentsOfArcsOutlastAMirror) {
  EXPECT_THAT(
      moves_of({kStart, kPole, "C X+0 Y+10 DR+", "CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X",
                "CT X+10 Y+20"}),
      ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 ccw90 F100", "A X-10 Y20 c0,20 cw90 F100"));
}

const std::vector<std::string> kTurned{"TOOL DEF 1 L+0 R+2",     "TOOL CALL 1 Z S100",
                                       "CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT+30",
                                       "TOOL CALL 1 Y S100",     "L Z+10 X+0 R0 F100 M03"};

std::vector<std::string> turned(std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(), kTurned.begin(), kTurned.end());
  return moves_of(blocks);
}

// HD-097, HD-182: the rotation belongs to the plane it was defined in (XY): it would turn a circle
// of ZX out of the main planes.
TEST(TncCircle, ARotationOfAnotherPlaneLeavesNoCircle) {
  const std::string pole = "CC Z+0 X+0";
  const std::string refused = "! PLANE WRONGLY DEFINED";
  EXPECT_EQ(turned({pole, "C Z+0 X+10 DR+"}).back(), refused);
  EXPECT_EQ(turned({pole, "CP PA+90 DR+"}).back(), refused);
  EXPECT_EQ(turned({"L Z+20 X+0", "CT Z+30 X+10"}).back(), refused);
  EXPECT_EQ(turned({"L Z+20 X+0", "RND R2", "L Z+20 X+10"}).back(), refused);
  EXPECT_EQ(turned({"CYCL DEF 5.0 CIRCULAR POCKET", "CYCL DEF 5.1 SET-UP -2",
                    "CYCL DEF 5.2 DEPTH -4", "CYCL DEF 5.3 PECKING -4 F20",
                    "CYCL DEF 5.4 RADIUS 10", "CYCL DEF 5.5 F100 DR+", "CYCL CALL"})
                .back(),
            refused);
  // a straight line is one in any plane: X 10 lies at 30 degrees
  EXPECT_EQ(turned({"L X+10"}).back(), "L X8.66 Y5 Z10 F100");
  EXPECT_EQ(
      turned({"CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT+0", pole, "C Z+0 X+10 DR+"}).back(),
      "A X10 Z0 c0,0 ccw90 F100");
}

// HD-097, HD-183: the plane alone was scaled, and a circle of another would be an ellipse.
TEST(TncCircle, AScaleOfOneAxisLeavesNoCircle) {
  const PathSetup plane{"[control]\nscale_three_axes = false", {}};
  const std::vector<std::string> blocks{"TOOL CALL 0 Z S100",  "CYCL DEF 11.0 SCALING",
                                        "CYCL DEF 11.1 SCL 2", "TOOL CALL 0 Y S100",
                                        "L Z+10 X+0 R0 F100",  "CC Z+0 X+0",
                                        "C Z+0 X+10 DR+"};
  EXPECT_EQ(moves_of(blocks, plane).back(), "! PLANE WRONGLY DEFINED");
  EXPECT_EQ(moves_of(blocks).back(), "A X20 Z0 c0,0 ccw90 F100");
}

}  // namespace
}  // namespace dripline::interpreter
