#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

std::vector<std::string> events_of(const std::vector<std::string>& blocks,
                                   const std::string& control = "") {
  PathSetup setup;
  if (!control.empty()) setup.setup = "[control]\n" + control;
  auto events = run_blocks(blocks, setup).events;
  if (!events.empty() && events.back().starts_with("end")) events.pop_back();
  return events;
}

// HD-134, HD-136: on before the motion, off after it.
TEST(TncMachine, SpindleAndCoolantSwitchAtTheirEndOfTheBlock) {
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S800", "L X+1 R0 F MAX M03", "L X+2 F MAX M08",
                         "L X+3 F MAX M05", "L X+4 F MAX M09", "L X+5 F MAX M14", "TOOL CALL S900",
                         "L X+6 F MAX M13", "L X+7 F MAX M04"}),
              ElementsAre("T0 L0 R0", "S cw 800", "R X1", "coolant on", "R X2", "R X3", "S off 0",
                          "R X4", "coolant off", "S ccw 800", "coolant on", "R X5", "S ccw 900",
                          "S cw 900", "coolant on", "R X6", "S ccw 900", "R X7"));
}

// HD-133, HD-140
TEST(TncMachine, StopsAndEnds) {
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S800", "L X+1 R0 F MAX M13", "L X+2 F MAX M00", "STOP",
                         "STOP M08"}),
              ElementsAre("T0 L0 R0", "S cw 800", "coolant on", "R X1", "R X2", "S off 0",
                          "coolant off", "stop", "stop", "coolant on", "stop"));
  for (const char* m : {"M02", "M30"}) {
    const auto run =
        run_blocks({"L X+1 R0 F MAX M08", std::string("L X+2 F MAX ") + m, "L X+3 F MAX"});
    EXPECT_THAT(run.events,
                ElementsAre("coolant on", "R X1", "R X2", "coolant off", "end 3 rewind"));
  }
}

// HD-135: M06 stops the program where the machine is set up so.
TEST(TncMachine, ToolChangesStopWhereTheMachineSaysSo) {
  EXPECT_THAT(events_of({"L X+1 R0 F MAX M06"}), ElementsAre("R X1", "M6"));
  EXPECT_THAT(events_of({"L X+1 R0 F MAX M08", "L X+2 F MAX M06"}, "m06_stop = true"),
              ElementsAre("coolant on", "R X1", "R X2", "coolant off", "M6", "stop tool"));
}

// HD-139, HD-137: free functions at the beginning or the end; M89 as a free one.
TEST(TncMachine, FreeFunctionsHaveTheirPlace) {
  EXPECT_THAT(
      events_of({"L X+1 R0 F MAX M07", "L X+2 F MAX M32", "L X+3 F MAX M61", "L X+4 F MAX M63"}),
      ElementsAre("M7", "R X1", "R X2", "M32", "M61", "R X3", "R X4", "M63"));
  EXPECT_THAT(events_of({"L X+1 R0 F MAX M89"}, "m89_modal = false"), ElementsAre("M89", "R X1"));
}

// HD-118: M90 changes nothing that a path shows.
TEST(TncMachine, M90IsNoOutput) {
  EXPECT_THAT(events_of({"L X+1 R0 F MAX M90"}), ElementsAre("R X1"));
}

// HD-141: the next preferred number; HD-142, HD-143
TEST(TncMachine, SpeedsAreCodedOrLimited) {
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S130", "STOP M03"}, "spindle = \"coded\""),
              ElementsAre("T0 L0 R0", "S cw 140", "stop"));
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S140", "STOP M03"}, "spindle = \"coded\""),
              ElementsAre("T0 L0 R0", "S cw 140", "stop"));
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S9500"}, "spindle = \"coded\"").back(),
              testing::StartsWith("! WRONG RPM"));
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S3000,5", "STOP M03"}, "spindle_maximum = 3000").back(),
              testing::StartsWith("! WRONG RPM"));
  EXPECT_THAT(events_of({"TOOL CALL 0 Z S29999,5", "STOP M03"}),
              ElementsAre("T0 L0 R0", "S cw 29999.5", "stop"));
}

// HD-129, HD-130, HD-006, HD-007: TOOL CALL takes length and radius of its TOOL DEF; 0 is none.
TEST(TncMachine, ToolsAreDefinedAndCalled) {
  EXPECT_THAT(
      events_of({"FN 0: Q1 = +12,5", "TOOL DEF 3 L-Q1 R+4", "TOOL CALL 3 Z S100", "TOOL CALL 0"}),
      ElementsAre("T3 L-12.5 R4", "T0 L0 R0"));
  EXPECT_THAT(events_of({"TOOL CALL 9 Z S100"}).back(), testing::StartsWith("! TOOL DEF MISSING"));
}

// HD-129: a tool may be defined after its call, in either form; the first definition counts until
// the run comes to one, and Q parameters are what they are at the call.
TEST(TncMachine, ToolsMayBeDefinedAfterTheirCall) {
  EXPECT_THAT(events_of({"FN 0: Q1 = +7", "TOOL CALL 3 Z S100", "STOP M02", "TOOL DEF 3 L+Q1 R+4",
                         "TOOL DEF 3 L+9 R+9"}),
              ElementsAre("T3 L7 R4"));
  EXPECT_THAT(events_of({"TOOL CALL 3 Z S100", "TOOL DEF 3 L+1 R+1", "TOOL DEF 3 L+2 R+2",
                         "TOOL CALL 3 Z S100"}),
              ElementsAre("T3 L1 R1", "T3 L2 R2"));
  EXPECT_THAT(run_text("%3 G70 *\nN1 T4 G17 S100 *\nN2 T4 G99 R0,5 L+1 *\nN9999 %3 G70 *\n").events,
              ElementsAre("T4 L25.4 R12.7", testing::StartsWith("end")));
  // a next tool is no definition
  EXPECT_THAT(events_of({"TOOL CALL 3 Z S100", "TOOL DEF 3"}).back(),
              testing::StartsWith("! TOOL DEF MISSING"));
}

// HD-230: without the tool file, blockwise transfer only has the tool defined last.
TEST(TncMachine, BlockwiseTransferHasTheToolDefinedLast) {
  const std::string restricted = "blockwise_restrictions = true";
  EXPECT_THAT(
      events_of({"TOOL DEF 3 L+1 R+1", "TOOL DEF 4 L+2 R+2", "TOOL CALL 4 Z S100"}, restricted),
      ElementsAre("T4 L2 R2"));
  EXPECT_THAT(
      events_of({"TOOL DEF 3 L+1 R+1", "TOOL DEF 4 L+2 R+2", "TOOL CALL 3 Z S100"}, restricted),
      ElementsAre("! NOT PERMITTED IN BLOCKWISE TRANSFER: TOOL CALL 3, the tool defined "
                  "last is 4"));
  EXPECT_THAT(events_of({"TOOL CALL 3 Z S100", "TOOL DEF 3 L+1 R+1"}, restricted).back(),
              testing::StartsWith("! TOOL DEF MISSING"));
  const PathSetup store{
      "[[tool]]\nnumber = 3\nlength = 50\nradius = 6\n[control]\ncentral_tool_file = true\n"
      "blockwise_restrictions = true",
      {}};
  EXPECT_THAT(run_blocks({"TOOL DEF 4 L+2 R+2", "TOOL CALL 3 Z S100"}, store).events,
              ElementsAre("T3 L50 R6", testing::StartsWith("end")));
}

// HD-067, HD-070: the central tool file, and the next tool.
TEST(TncMachine, TheCentralToolFileGoesBeforeDefinitions) {
  const PathSetup store{
      "[[tool]]\nnumber = 3\nlength = 50\nradius = 6\n[control]\ncentral_tool_file = true", {}};
  const auto run = run_blocks({"TOOL DEF 4", "TOOL CALL 3 Z S100"}, store);
  EXPECT_THAT(run.events, ElementsAre("next T4", "T3 L50 R6", testing::StartsWith("end")));
}

// HD-023, HD-199: the MAX corner may count from the MIN corner.
TEST(TncMachine, TheBlankIsTold) {
  EXPECT_THAT(events_of({"BLK FORM 0.1 Z X+1 Y+2 Z-20", "BLK FORM 0.2 IX+99 IY+98 IZ+20"}),
              ElementsAre("blank Z X1 Y2 Z-20 to X100 Y100 Z0"));
  EXPECT_THAT(events_of({"BLK FORM 0.1 Z X+1 Y+2 Z-20", "BLK FORM 0.2 X+0 Y+98 Z+0"}).back(),
              testing::StartsWith("! BLK FORM DEFINITION INCORRECT"));
  EXPECT_THAT(events_of({"BLK FORM 0.2 X+0 Y+98 Z+0"}).back(),
              testing::StartsWith("! BLK FORM DEFINITION INCORRECT"));
}

PathRun probed(const std::string& surface, std::vector<std::string> blocks) {
  blocks.insert(blocks.begin(), {"TOOL DEF 9 L+0 R+2", "TOOL CALL 9 Z S1"});
  return run_blocks(blocks,
                    {"start = { Z = 60.0 }\n[probe]\nsurface = [ " + surface + " ]", {}, "MM"});
}

// HD-214, HD-215: in contact where probing begins, 2 mm in front of the point.
TEST(TncMachine, ADeflectedStylusTouchesNothing) {
  const std::vector<std::string> blocks{"TCH PROBE 0.0 REF. PLANE Q5 Z-",
                                        "TCH PROBE 0.1 X+10 Y+20 Z+0"};
  const auto run = probed("{ axis = \"Z\", at = 2.0 }", blocks);
  EXPECT_EQ(run.alarm_id, "TNC-TOUCH-POINT");
  EXPECT_EQ(run.alarm_line, 5u);
  EXPECT_THAT(run.events,
              ElementsAre("T9 L0 R2", "R X10 Y20 Z2", "probe X10 Y20 Z2",
                          "! TOUCH POINT INACCESSIBLE: the stylus is deflected at the start"));
  EXPECT_EQ(probed("{ axis = \"Z\", at = 1.999 }", blocks).alarm_id, "");
}

// HD-214, HD-183: set-up clearance and travel are machine parameters: Z 10 lies at 20, begins at
// 22 and ends at 122 in front of it, or after it.
TEST(TncMachine, ProbingIsNotScaled) {
  const std::vector<std::string> blocks{"CYCL DEF 11.0 SCALING", "CYCL DEF 11.1 SCL 2",
                                        "TCH PROBE 0.0 REF. PLANE Q5 Z-",
                                        "TCH PROBE 0.1 X+10 Y+20 Z+10", "L Z+Q5 R0 F100"};
  EXPECT_THAT(probed("{ axis = \"Z\", at = 19.0 }", blocks).events,
              ElementsAre("T9 L0 R2", "R X20 Y40 Z22", "probe X20 Y40 Z19", "R X20 Y40 Z22",
                          "L X20 Y40 Z19 F100", "end 9"));
  EXPECT_EQ(probed("{ axis = \"Z\", at = -77.9 }", blocks).alarm_id, "");
  EXPECT_EQ(probed("{ axis = \"Z\", at = -78.1 }", blocks).alarm_id, "TNC-TOUCH-POINT");
}

// HD-140, HD-133: the stop of an ISO block is after its motion, with G38 as with M00; M is before
// or after the motion as it would be without.
TEST(TncMachine, AnIsoBlockStopsAfterItsMotion) {
  const auto events = [](const std::string& words) {
    const auto run = run_text("%5 G71 *\nN1 T0 G17 S800 *\nN2 G00 G40 G90 X+0 Y+0 M03 *\nN3 " +
                              words + " *\nN9999 %5 G71 *\n");
    return std::vector(run.events.begin() + 2, run.events.end() - 1);
  };
  EXPECT_THAT(events("X+5 M00"), ElementsAre("R X5 Y0", "S off 0", "stop"));
  EXPECT_THAT(events("G38 X+5 M00"), ElementsAre("R X5 Y0", "S off 0", "stop"));
  EXPECT_THAT(events("G38 X+5 M05"), ElementsAre("R X5 Y0", "S off 0", "stop"));
  EXPECT_THAT(events("G38 X+5"), ElementsAre("R X5 Y0", "stop"));
  EXPECT_THAT(events("G38 X+5 M08"), ElementsAre("coolant on", "R X5 Y0", "stop"));
  EXPECT_THAT(events("G38 M08"), ElementsAre("coolant on", "stop"));
  EXPECT_THAT(events("T0 G17 S900 G38 M08"),
              ElementsAre("coolant on", "T0 L0 R0", "S cw 900", "stop"));
}

// HD-138, HD-140: M99 calls the cycle of its block, and the run stops after it; M89 from there on.
TEST(TncMachine, AStopCallsTheCycle) {
  const std::vector<std::string> start{"TOOL DEF 1 L+0 R+5",     "TOOL CALL 1 Z S100",
                                       "CYCL DEF 2.0 TAPPING",   "CYCL DEF 2.1 SET-UP -2",
                                       "CYCL DEF 2.2 DEPTH -10", "CYCL DEF 2.3 DWELL 0",
                                       "CYCL DEF 2.4 F50",       "L X+10 Y+0 R0 F MAX M03"};
  const auto after = [&](const std::vector<std::string>& blocks) {
    std::vector<std::string> all = start;
    all.insert(all.end(), blocks.begin(), blocks.end());
    auto events = events_of(all);
    events.erase(events.begin(), events.begin() + 3);  // the tool, the spindle, the move there
    return events;
  };
  const auto called = after({"L R F M99"});
  ASSERT_GT(called.size(), 2u);
  auto stopped = called;
  stopped.push_back("stop");
  EXPECT_EQ(after({"STOP M99"}), stopped);
  const auto modal = after({"STOP M89", "L X+10 F MAX"});
  EXPECT_EQ(modal.front(), "stop");
  EXPECT_EQ(std::vector(modal.begin() + 1, modal.end()), called);
  EXPECT_THAT(events_of({"STOP M99"}), ElementsAre(testing::StartsWith("! CYCL INCOMPLETE")));
  EXPECT_THAT(events_of({"STOP M89"}, "m89_modal = false"), ElementsAre("M89", "stop"));
}

// HD-204: the graphics need the tool along the blank's axis, and a TOOL CALL that names it.
TEST(TncMachine, SaysThatTheGraphicsShowNoToolAcrossTheBlank) {
  const auto warns = [](const std::vector<std::string>& calls, bool is_blank_first) {
    std::vector<std::string> blocks{"BLK FORM 0.1 Z X+0 Y+0 Z-20", "BLK FORM 0.2 X+9 Y+9 Z+0"};
    blocks.insert(is_blank_first ? blocks.end() : blocks.begin(), calls.begin(), calls.end());
    blocks.insert(blocks.begin(), "TOOL DEF 1 L+0 R+5");
    const auto events = events_of(blocks);
    return std::count(events.begin(), events.end(), "warning TNC-GRAPHICS");
  };
  for (const bool is_blank_first : {true, false}) {
    EXPECT_EQ(warns({"TOOL CALL 1 Z S100"}, is_blank_first), 0);
    EXPECT_EQ(warns({"TOOL CALL 1 Y S100"}, is_blank_first), 1);
    EXPECT_EQ(warns({"TOOL CALL 1 S100"}, is_blank_first), 1) << "the blank's axis is not enough";
    EXPECT_EQ(warns({"TOOL CALL 0 Y S100"}, is_blank_first), 0) << "no tool";
  }
  EXPECT_EQ(warns({"TOOL CALL 1 Z S100", "TOOL CALL Y"}, true), 1);
  EXPECT_EQ(warns({"TOOL CALL 1 Z S100", "TOOL CALL S200"}, true), 0);
  EXPECT_THAT(events_of({"BLK FORM 0.1 Z X+0 Y+0 Z-20", "BLK FORM 0.2 X+9 Y+9 Z+0",
                         "TOOL DEF 1 L+0 R+5", "TOOL CALL 1 Y S100", "TOOL CALL Z"}),
              testing::Contains("warning TNC-GRAPHICS-AGAIN"));
  EXPECT_THAT(events_of({"TOOL DEF 1 L+0 R+5", "TOOL CALL 1 Y S100"}),
              testing::Not(testing::Contains("warning TNC-GRAPHICS")))
      << "without a blank there are no graphics";
}

// HD-199: the blank is clamped where the datum is, as the moves are.
TEST(TncMachine, TheBlankLiesAtTheDatum) {
  const std::vector<std::string> blank{"BLK FORM 0.1 Z X+0 Y+0 Z-20", "BLK FORM 0.2 X+100 Y+50 Z+0",
                                       "L X+100 Y+50 R0 F9999"};
  const auto after = [&](std::vector<std::string> blocks) {
    blocks.insert(blocks.end(), blank.begin(), blank.end());
    return blocks;
  };
  const PathSetup datum{"[[offset]]\nname = \"datum\"\nX = 200\nZ = -7", {}};
  EXPECT_THAT(run_blocks(blank, datum).events,
              ElementsAre("blank Z X200 Y0 Z-27 to X300 Y50 Z-7", "L X300 Y50 F9999",
                          testing::StartsWith("end")));
  // a shift in force moves the datum
  EXPECT_THAT(
      run_blocks(after({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+30", "CYCL DEF 7.2 Y-5"}),
                 datum)
          .events,
      ElementsAre("blank Z X230 Y-5 Z-27 to X330 Y45 Z-7", "L X330 Y45 F9999",
                  testing::StartsWith("end")));
  // mirroring, rotation and scaling are about the path
  EXPECT_THAT(
      run_blocks(after({"CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X", "CYCL DEF 10.0 ROTATION",
                        "CYCL DEF 10.1 ROT +90", "CYCL DEF 11.0 SCALING", "CYCL DEF 11.1 SCL 2"}),
                 datum)
          .events,
      testing::Contains("blank Z X200 Y0 Z-27 to X300 Y50 Z-7"));
  // a workpiece that lies askew is held by the blank with all its corners
  const PathSetup turned{
      "[[offset]]\nname = \"datum\"\nX = 200\nZ = -7\n[control]\nbasic_rotation = 90", {}};
  EXPECT_THAT(run_blocks(blank, turned).events,
              ElementsAre("blank Z X150 Y0 Z-27 to X200 Y100 Z-7", "L X150 Y100 F9999",
                          testing::StartsWith("end")));
}

// HD-006, HD-067: the tool store where it is on, the TOOL DEF that was executed last, the first one
// further on, and only then what the setup has besides.
TEST(TncMachine, ToolsAreLookedForInTheirOrder) {
  const std::string store = "[[tool]]\nnumber = 3\nlength = 0\nradius = 8\n";
  const auto tools_of = [](const std::vector<std::string>& blocks, const std::string& setup) {
    std::vector<std::string> tools;
    for (const auto& event : run_blocks(blocks, {setup, {}}).events) {
      if (event.starts_with("T")) tools.push_back(event);
    }
    return tools;
  };
  const std::vector<std::string> ahead{"TOOL CALL 3 Z S 100", "TOOL DEF 3 L+0 R+2",
                                       "TOOL DEF 3 L+0 R+4", "TOOL CALL 3 Z"};
  EXPECT_THAT(tools_of(ahead, store), ElementsAre("T3 L0 R2", "T3 L0 R4"));
  EXPECT_THAT(tools_of(ahead, store + "[control]\ncentral_tool_file = true"),
              ElementsAre("T3 L0 R8", "T3 L0 R8"));
  EXPECT_THAT(tools_of({"TOOL CALL 3 Z S 100"}, store), ElementsAre("T3 L0 R8"));
  // a slow line need not bring the whole program first
  EXPECT_THAT(tools_of(ahead, store + "[control]\nprogram_check = \"call\""),
              ElementsAre("T3 L0 R8", "T3 L0 R4"));
  std::vector<std::string> far{"TOOL CALL 3 Z S 100"};
  far.insert(far.end(), 3200, "FN 0: Q1 = +1");
  far.push_back("TOOL DEF 3 L+0 R+2");
  EXPECT_THAT(tools_of(far, store), ElementsAre("T3 L0 R8"));
  EXPECT_THAT(tools_of(far, ""), ElementsAre("T3 L0 R2"));
}

}  // namespace
}  // namespace dripline::interpreter
