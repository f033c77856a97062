#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

/// A start in the middle of a program finds the state that the program has there, or is refused.
namespace dripline::interpreter {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

PathRun from_block(int block, const std::vector<std::string>& blocks, const std::string& setup = "",
                   int pass = 0) {
  std::string text = "0 BEGIN PGM 5 MM\n";
  std::size_t at = 1;
  for (const std::string& each : blocks) text += std::to_string(at++) + " " + each + "\n";
  text += std::to_string(at) + " END PGM 5 MM\n";
  return run_text(
      text,
      {fmt::format("{}\n[control]\nstart_block = {}\nstart_pass = {}\n", setup, block, pass), {}});
}

/// The reason for a refusal, of which nothing may have moved, turned or changed before.
std::string refusal(const PathRun& run) {
  if (run.events.size() != 1 || !run.events[0].starts_with("! PROGRAM START UNDEFINED")) {
    return "not refused: " + testing::PrintToString(run.events);
  }
  return run.events[0];
}

const std::vector<std::string> kContour{"TOOL DEF 1 L+20 R+5",
                                        "TOOL CALL 1 Z S1000",
                                        "CYCL DEF 7.0 DATUM SHIFT",
                                        "CYCL DEF 7.1 X+100",
                                        "L X+0 Y-20 R0 F MAX M13",
                                        "L X+0 Y+0 RR F500",
                                        "STOP",
                                        "L X+0 Y+50 RR",
                                        "L X+60 Y+50",
                                        "L X+60 Y-20 R0",
                                        "L X+70 Y-20"};

// HD-192: tool, datum shift, spindle, coolant and feed are those of the program at that block; the
// operator is asked before any axis or spindle moves.
TEST(TncStart, RebuildsWhatTheProgramHadInForce) {
  EXPECT_THAT(from_block(11, kContour, "start = { X = 160.0, Y = -20.0 }").events,
              ElementsAre("T1 L20 R5", "stop", "S cw 1000", "coolant on", "L X170 Y-20 F500",
                          StartsWith("end")));
}

// HD-192: the contour is made as by a run from the beginning.
TEST(TncStart, BeginsTheContourWithItsTool) {
  const auto whole = run_text(
      "0 BEGIN PGM 5 MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S1000\n"
      "3 L X+0 Y-20 R0 F MAX M03\n4 L X+0 Y+0 RR F500\n5 L X+0 Y+50\n"
      "6 L X+60 Y+50\n7 L X+60 Y-20 R0\n8 END PGM 5 MM\n",
      {"start = { Y = -20.0 }", {}});
  const auto late =
      from_block(4,
                 {"TOOL DEF 1 L+0 R+5", "TOOL CALL 1 Z S1000", "L X+0 Y-20 R0 F MAX M03",
                  "L X+0 Y+0 RR F500", "L X+0 Y+50", "L X+60 Y+50", "L X+60 Y-20 R0"},
                 "start = { Y = -20.0 }");
  ASSERT_EQ(whole.alarm_id, "");
  ASSERT_EQ(late.alarm_id, "");
  const auto tail = [](const PathRun& run) {
    return std::vector(run.events.end() - 5, run.events.end());
  };
  EXPECT_EQ(tail(late), tail(whole));
}

std::string alarm_of(const PathRun& run) {
  return run.events.empty() ? "" : run.events.back();
}

const std::vector<std::string> kPolar{"TOOL DEF 1 L+0 R+2",
                                      "TOOL CALL 1 Z S1000",
                                      "L X+0 Y+0 R0 F500 M03",
                                      "CC X+20 Y+20",
                                      "L X+40 Y+20",
                                      "CP PA+180 DR+",
                                      "CC",
                                      "L X+60 Y+20",
                                      "LP PR+10 PA+90"};

// HD-192: the present position is the machine's, and none of the program.
TEST(TncStart, TakesNoPoleFromWhereTheMachineIs) {
  EXPECT_THAT(alarm_of(from_block(7, kPolar, "start = { X = 3.0, Y = -30.0 }")),
              HasSubstr("CC by the present position after GOTO"));
  for (const char* pole : {"CC X+5", "CC IX+1 Y+2", "CC IX+0 IY+0"}) {
    auto blocks = kPolar;
    blocks[6] = pole;
    EXPECT_THAT(alarm_of(from_block(7, blocks, "start = { X = 0.0, Y = 20.0 }")),
                HasSubstr("CC by the present position after GOTO"))
        << pole;
  }
  auto blocks = kPolar;
  blocks[6] = "CC X+5 Y+6";
  EXPECT_EQ(from_block(7, blocks, "start = { X = 3.0, Y = -30.0 }").alarm_id, "");
}

// HD-192: an arc begins where the program has it begin.
TEST(TncStart, BeginsNoArcElsewhere) {
  EXPECT_THAT(alarm_of(from_block(6, kPolar, "start = { X = 40.0, Y = 10.0 }")),
              HasSubstr("Y is at 10.000 and the program has it at 20.000 here"));
  const auto there = from_block(6, kPolar, "start = { X = 40.0, Y = 20.0 }");
  EXPECT_EQ(there.alarm_id, "");
}

// HD-192: what continues the first move is as the program has it, wherever the tool came from.
TEST(TncStart, ATangentialArcAfterTheFirstMoveIsThatOfTheProgram) {
  const std::vector<std::string> blocks{"TOOL DEF 1 L+0 R+2", "TOOL CALL 1 Z S1000",
                                        "L X+0 Y+0 R0 F500 M03", "L X+20 Y+0", "CT X+40 Y+20"};
  const auto whole = run_text(
      "0 BEGIN PGM 5 MM\n1 TOOL DEF 1 L+0 R+2\n2 TOOL CALL 1 Z S1000\n3 L X+0 Y+0 R0 F500 M03\n4 L "
      "X+20 Y+0\n"
      "5 CT X+40 Y+20\n6 END PGM 5 MM\n");
  const auto late = from_block(4, blocks, "start = { X = 20.0, Y = -30.0 }");
  ASSERT_EQ(late.alarm_id, "");
  ASSERT_GE(late.events.size(), 2u);
  EXPECT_EQ(late.events[late.events.size() - 2], whole.events[whole.events.size() - 2]);
}

TEST(TncStart, RoundsNoCornerBehindAMoveFromElsewhere) {
  for (const char* corner : {"RND R5", "L5"}) {
    const std::vector<std::string> blocks{
        "TOOL DEF 1 L+0 R+2", "TOOL CALL 1 Z S1000", "L X+0 Y+0 R0 F500 M03", "L X+20 Y+0", corner,
        "L X+20 Y+30"};
    EXPECT_THAT(alarm_of(from_block(4, blocks, "start = { X = 20.0, Y = -30.0 }")),
                HasSubstr("RND or a chamfer after the first positioning block: X is at 20.000"))
        << corner;
    EXPECT_EQ(from_block(4, blocks).alarm_id, "") << "it is where the program has it";
  }
}

// The tangential approach comes from where the tool is.
TEST(TncStart, WarnsOfAnApproachByWhereTheToolComesFrom) {
  const std::vector<std::string> blocks{"TOOL DEF 1 L+0 R+2",
                                        "TOOL CALL 1 Z S1000",
                                        "L X-30 Y-40 R0 F500 M03",
                                        "L X+0 Y+0 RL",
                                        "RND R3",
                                        "L X+0 Y+50"};
  const auto warnings = [&](const char* start) {
    const auto run = from_block(4, blocks, start);
    return std::ranges::count(run.events, "warning TNC-QUADRANT");
  };
  EXPECT_EQ(warnings("start = { X = 30.0, Y = 10.0 }"), 1);
  EXPECT_EQ(warnings("start = { X = -30.0, Y = -40.0 }"), 0);
}

// HD-192: the datum that M94 moves is kept from run to run, and would move once more.
TEST(TncStart, IsRefusedAfterADatumThatM94HasMoved) {
  EXPECT_THAT(refusal(from_block(3, {"L C+730 R0 F9999", "L C+740 M94", "L C+20"})),
              HasSubstr("the datum of C, which it has moved by +720"));
  EXPECT_THAT(from_block(3, {"L C+30 R0 F9999", "L C+40 M94", "L C+20"}).events,
              Not(testing::Contains(HasSubstr("M94"))));
}

// HD-192: CC, the polar coordinates that refer to it, and the cycle defined last.
TEST(TncStart, RebuildsThePoleAndTheCycle) {
  EXPECT_THAT(
      from_block(4, {"CC X+20 Y+10", "L X+0 Y+0 R0 F100", "L X+1 Y+1", "LP PR+10 PA+0 R0 F100"},
                 "start = { X = 1.0, Y = 1.0 }")
          .events,
      ElementsAre("stop", "L X30 Y10 F100", StartsWith("end")))
      << "an offline start is where the program began";
  const std::vector<std::string> cycle{
      "TOOL DEF 1 L+0 R+2",    "CYCL DEF 1.0 PECKING",  "CYCL DEF 1.1 SET-UP -2",
      "CYCL DEF 1.2 DEPTH -5", "CYCL DEF 1.3 PECKG -5", "CYCL DEF 1.4 DWELL 0",
      "CYCL DEF 1.5 F80",      "TOOL CALL 1 Z S 100",   "L X+3 Y+3 R0 F MAX M03",
      "CYCL CALL M",           "L X+9 Y+9 R0 F MAX M99"};
  EXPECT_EQ(from_block(8, cycle).alarm_id, "");
  EXPECT_EQ(from_block(11, cycle).alarm_id, "");
  EXPECT_THAT(from_block(11, cycle).events, testing::Contains("L X9 Y9 Z-7 F80"));
  EXPECT_THAT(from_block(10, cycle).events.back(),
              HasSubstr("a cycle call after GOTO, before the first positioning block"));
  EXPECT_THAT(refusal(from_block(4, cycle)), HasSubstr("CYCL DEF 1"));
}

// HD-193: repeats, return addresses and the contour cannot be rebuilt: which pass was meant, and
// on which side the tool is, is unknown. Each is named.
TEST(TncStart, RefusesWhatItWouldLose) {
  EXPECT_THAT(refusal(from_block(9, kContour)), HasSubstr("block 6 on: start there"));
  EXPECT_THAT(
      refusal(from_block(2, {"LBL 1", "L X+1 Y+1 R0 F MAX", "L IX+1 F MAX", "CALL LBL 1 REP 2/2"})),
      HasSubstr("how often block 4 leads back over it"));
  EXPECT_THAT(refusal(from_block(
                  4, {"CALL LBL 5 REP", "STOP M02", "LBL 5", "L X+1 Y+1 R0 F MAX", "LBL 0"})),
              HasSubstr("repeats and return address of LBL 5, which line 2 calls"));
  EXPECT_THAT(refusal(from_block(3, {"FN 0: Q1 = +0", "LBL 2", "L X+1 Y+1 R0 F MAX",
                                     "FN 1: Q1 = +Q1 + +1", "FN 12: IF +Q1 LT +3 GOTO LBL 2"})),
              HasSubstr("how often block 5 leads back over it"));
  EXPECT_THAT(refusal(from_block(3, {"L X+1 Y+1 R0 F100", "RND R2", "L X+9 Y+1", "L X+9 Y+9"})),
              HasSubstr("the corner from block 1 on"));
  EXPECT_THAT(refusal(from_block(2, {"L X+1 Y+1 R0 F100", "RND R2", "L X+9 Y+1", "L X+9 Y+9"})),
              HasSubstr("the corner from block 1 on"));
  EXPECT_THAT(refusal(from_block(2, {"FN 1: Q1 = +Q1 + +1", "L X+1 Y+1 R0 F MAX"})),
              HasSubstr("lose Q1, whose value continues that of the run before"));
  for (const std::string use :
       {"FN 9: IF +Q1 EQU +9 GOTO LBL 1", "L X+Q1 Y+1 R0 F MAX", "L X+1 Y+1 R0 F+Q1", "CC X+Q1 Y+0",
        "FN 0: Q2 = +Q1", "LP PR+10 PA+Q1 R0 F MAX"}) {
    const std::vector<std::string> blocks{"CC X+0 Y+0", use, "LBL 1", "FN 0: Q1 = +5",
                                          "L X+1 Y+1 R0 F MAX"};
    EXPECT_THAT(refusal(from_block(5, blocks, "[[variable]]\nname = \"Q1\"\nvalue = 5.0")),
                HasSubstr("a start after block 4 would lose Q1"))
        << use;
  }
  EXPECT_THAT(refusal(from_block(4, {"TOOL CALL 0 Z S100", "TCH PROBE 0.0 REF. PLANE Q5 Z-",
                                     "TCH PROBE 0.1 X+0 Y+0 Z+0", "L X+1 Y+1 R0 F MAX"})),
              HasSubstr("what the probe has measured"));
  const std::string changer =
      "[[tool]]\nnumber = 1\nradius = 2.0\npocket = 1\n[[tool]]\nnumber = 2\nradius = 3.0\n"
      "pocket = 2\n[control]\ncentral_tool_file = true\nrandom_changer = true\n"
      "magazine_pockets = 4\nstart_block = 2\n";
  EXPECT_THAT(refusal(run_text("0 BEGIN PGM 5 MM\n1 TOOL CALL 1 Z S100\n2 L X+1 Y+1 R0 F MAX\n"
                               "3 END PGM 5 MM\n",
                               {changer, {}})),
              HasSubstr("which pockets the tools are in"));
}

// HD-193: labels that do not come back over the block do no harm.
TEST(TncStart, PassesFinishedRepeatsAndSubprograms) {
  const std::vector<std::string> blocks{
      "LBL 1",          "L X+1 Y+1 R0 F MAX", "L IX+1 F MAX",   "CALL LBL 1 REP 2/2",
      "CALL LBL 7 REP", "L X+9 Y+9 F MAX",    "CALL LBL 7 REP", "STOP M02",
      "LBL 7",          "L X+5 Y+5 F MAX",    "LBL 0"};
  EXPECT_THAT(from_block(6, blocks, "start = { X = 5.0, Y = 5.0 }").events,
              ElementsAre("stop", "R X9 Y9", "R X5 Y5", StartsWith("end")));
}

PathRun from_pass(int block, int pass, const std::vector<std::string>& blocks) {
  return from_block(block, blocks, "", pass);
}

const std::vector<std::string> kRepeat{"LBL 1", "L X+1 Y+1 R0 F MAX", "L IX+1 F MAX",
                                       "CALL LBL 1 REP 2/2", "L X+9 Y+9 F MAX"};

// HD-193: as by the arrow keys, repeats are kept: so many are left as in the pass that is named.
TEST(TncStart, ContinuesInTheRepeatThatIsNamed) {
  EXPECT_THAT(from_pass(2, 2, kRepeat).events,
              ElementsAre("stop", "R X1 Y1", "R X2 Y1", "R X1 Y1", "R X2 Y1", "R X9 Y9",
                          StartsWith("end")));
  EXPECT_THAT(from_pass(2, 3, kRepeat).events,
              ElementsAre("stop", "R X1 Y1", "R X2 Y1", "R X9 Y9", StartsWith("end")));
}

// HD-193: and so are return addresses, of the call that is named.
TEST(TncStart, ReturnsFromTheSubprogramThatItStartsIn) {
  const std::vector<std::string> blocks{
      "CALL LBL 5 REP",     "L X+7 Y+7 R0 F MAX", "CALL LBL 5 REP",
      "L X+9 Y+9 F MAX",    "STOP M02",           "LBL 5",
      "L X+1 Y+1 R0 F MAX", "L X+2 Y+2 F MAX",    "LBL 0"};
  EXPECT_THAT(from_pass(8, 1, blocks).events, ElementsAre("stop", "R X2 Y2", "R X7 Y7", "R X1 Y1",
                                                          "R X2 Y2", "R X9 Y9", StartsWith("end")));
  EXPECT_THAT(from_pass(8, 2, blocks).events,
              ElementsAre("stop", "R X2 Y2", "R X9 Y9", StartsWith("end")));
}

TEST(TncStart, RefusesAPassThatDoesNotCome) {
  EXPECT_THAT(from_pass(2, 4, kRepeat).events.back(),
              HasSubstr("pass 4 of block 2: the program comes there 3 times"));
  EXPECT_THAT(refusal(from_pass(9, 1, kContour)), HasSubstr("block 6 on: start there"))
      << "a contour is lost all the same";
}

// HD-194: an axis that the first positioning leaves alone must be where the program has it.
TEST(TncStart, RefusesAMachineThatIsElsewhere) {
  const std::vector<std::string> blocks{"L X+0 Y+0 Z+50 R0 F MAX", "L Z-5 F100", "L X+9 Y+9"};
  const PathRun elsewhere = from_block(3, blocks);
  EXPECT_THAT(elsewhere.events.back(),
              HasSubstr("Z is at 0.000 and the program has it at -5.000 here"));
  EXPECT_THAT(elsewhere.events, Each(Not(StartsWith("L "))));
  EXPECT_EQ(from_block(3, blocks, "start = { Z = -5.0 }").alarm_id, "");
  EXPECT_EQ(from_block(1, blocks).alarm_id, "");
}

}  // namespace
}  // namespace dripline::interpreter
