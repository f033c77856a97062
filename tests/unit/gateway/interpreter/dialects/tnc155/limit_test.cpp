#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

/// HD-085: the limits of MOD function LIMIT hold the tool's path, and nothing of a move or a cycle
/// that leaves them is done.
namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

PathSetup within_100() {
  PathSetup setup;
  setup.setup = "[control]\nlimit_low = { X = -100.0, Z = -20.0 }\nlimit_high = { X = 100.0 }\n";
  return setup;
}
std::vector<std::string> path(std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(), {"TOOL DEF 1 L+0 R+5", "TOOL CALL 1 Z S100"});
  return moves_of(blocks, within_100());
}

TEST(TncLimit, AnArcCountsBetweenItsEnds) {
  EXPECT_THAT(path({"L X+80 Y+0 R0 F100", "CC X+80 Y+20", "C X+80 Y+40 DR+"}),
              ElementsAre("L X80 Y0 F100", "A X80 Y40 c80,20 ccw180 F100"));
  EXPECT_THAT(path({"L X+80 Y+0 R0 F100", "CC X+80 Y+21", "C X+80 Y+42 DR+"}),
              ElementsAre("L X80 Y0 F100", "! LIMIT SWITCH X+"));
  EXPECT_THAT(path({"L X+80 Y+0 R0 F100", "CC X+80 Y+21", "C X+80 Y+42 DR-"}),
              ElementsAre("L X80 Y0 F100", "A X80 Y42 c80,21 cw180 F100"));
}

TEST(TncLimit, TheCompensatedPathCounts) {
  const std::vector<std::string> outside = {"L X+80 Y-20 R0 F100", "L X+98 Y+0 RR", "L X+98 Y+30",
                                            "L X+80 Y+30 R0"};
  EXPECT_THAT(path(outside), ElementsAre("L X80 Y-20 F100", "! LIMIT SWITCH X+"));
  const std::vector<std::string> inside = {"L X+80 Y-20 R0 F100", "L X+102 Y+0 RL", "L X+102 Y+30",
                                           "L X+80 Y+30 R0"};
  EXPECT_THAT(path(inside),
              ElementsAre("L X80 Y-20 F100", "L X97 Y0 F100", "L X97 Y30 F100", "L X80 Y30 F100"));
}

TEST(TncLimit, TheAlarmNamesTheBlockOfTheMove) {
  const auto run = run_blocks({"TOOL DEF 1 L+0 R+5", "TOOL CALL 1 Z S100", "L X+80 Y-20 R0 F100",
                               "L X+80 Y+0 RR", "L X+98 Y+0", "L X+98 Y+30", "L Y+40"},
                              within_100());
  EXPECT_EQ(run.alarm_id, "TNC-LIMIT-SWITCH");
  EXPECT_EQ(run.alarm_line, 7u) << "the arc round the corner leads to its block";
}

TEST(TncLimit, ACycleThatLeavesThemIsNotBegun) {
  const std::vector<std::string> pocket = {
      "CYCL DEF 4.0 POCKET MILLING", "CYCL DEF 4.1 SET-UP-2", "CYCL DEF 4.2 DEPTH-4",
      "CYCL DEF 4.3 PECKG-4 F80",    "CYCL DEF 4.4 X+60",     "CYCL DEF 4.5 Y+40",
      "CYCL DEF 4.6 F100 DR+"};
  auto blocks = pocket;
  blocks.insert(blocks.end(), {"L X+80 Y+0 Z+2 R0 F100 M03", "CYCL CALL"});
  EXPECT_THAT(path(blocks), ElementsAre("L X80 Y0 Z2 F100", "! LIMIT SWITCH X+"));
  blocks[blocks.size() - 2] = "L X+70 Y+0 Z+2 R0 F100 M03";
  EXPECT_GT(path(blocks).size(), 5u);
  EXPECT_EQ(path(blocks).back().substr(0, 1), "R");
}

TEST(TncLimit, AHoleThatIsTooDeepIsNotBegun) {
  EXPECT_THAT(path({"CYCL DEF 1.0 PECKING", "CYCL DEF 1.1 SET-UP-2", "CYCL DEF 1.2 DEPTH-21",
                    "CYCL DEF 1.3 PECKG-5", "CYCL DEF 1.4 DWELL 0", "CYCL DEF 1.5 F80",
                    "L X+70 Y+0 Z+2 R0 F100 M03", "CYCL CALL"}),
              ElementsAre("L X70 Y0 Z2 F100", "! LIMIT SWITCH Z-"));
}

}  // namespace
}  // namespace dripline::interpreter
