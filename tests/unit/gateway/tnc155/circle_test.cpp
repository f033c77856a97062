#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

const std::string kStart = "L X+10 Y+0 R0 F100";
const std::string kPole = "CC X+0 Y+0";

// HD-101, HD-184: the way before lies in the machine where it lay, whatever coordinates count now.
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

// HD-101, HD-179: of an arc the centre counts and its turn in the machine: to the left at (0, 10).
TEST(TncCircle, TangentsOfArcsOutlastAMirror) {
  EXPECT_THAT(
      moves_of({kStart, kPole, "C X+0 Y+10 DR+", "CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X",
                "CT X+10 Y+20"}),
      ElementsAre("L X10 Y0 F100", "A X0 Y10 c0,0 ccw90 F100", "A X-10 Y20 c0,20 cw90 F100"));
}

}  // namespace
}  // namespace dripline::interpreter
