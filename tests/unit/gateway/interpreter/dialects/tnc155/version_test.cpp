// Programs that ask for what the control has not: rows HD-238 (software) and HD-239 (E and V).
#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using Blocks = std::vector<std::string>;

PathSetup control(const std::string& options, const std::string& before = "") {
  PathSetup setup;
  setup.setup = before + "[control]\n" + options;
  return setup;
}
PathSetup software(int number) {
  return control("software = " + std::to_string(number));
}

/// The alarm's id, its line, and its text; empty where there is none.
std::string alarm_of(const PathRun& run) {
  if (run.alarm_id.empty()) return "";
  return run.alarm_id + " " + std::to_string(run.alarm_line) + " " + run.events.back();
}
std::string alarm(const Blocks& blocks, const PathSetup& setup) {
  return alarm_of(run_blocks(blocks, setup));
}
std::string iso_alarm(const std::string& blocks, const PathSetup& setup) {
  return alarm_of(run_text("%1 G71*\n" + blocks + "N9999 %1 G71*\n", setup));
}

const Blocks kThreeAxes{"TOOL CALL 0 Z S 100", "L X+1 Y+2 R0 F100", "L X+10 Y+20 Z+5"};
const PathSetup kTncE = control("model = \"TNC 155 E\"");
const PathSetup kTncV = control("model = \"TNC 151 V\"");

// HD-239
TEST(Tnc155Version, RefusesThreeAxesAtOnceOnEAndV) {
  EXPECT_EQ(alarm(kThreeAxes, control("model = \"TNC 155 P\"")), "");
  EXPECT_EQ(alarm(kThreeAxes, {}), "");
  EXPECT_EQ(alarm(kThreeAxes, kTncE),
            "TNC-NOT-SUPPORTED 4 ! NOT SUPPORTED: XYZ in one block: a TNC 155 E has no straight "
            "lines of three axes at once");
  EXPECT_EQ(alarm({"TOOL CALL 0 Z S 100", "L X+1 Y+2 R0 F100", "L X+3 Z+5"}, kTncE), "");
  EXPECT_EQ(
      iso_alarm("N10 G17 G01 G40 G90 X+1 Y+2 F100*\nN20 X+10 Y+20 Z+5*\n", kTncV),
      "TNC-NOT-SUPPORTED 3 ! NOT SUPPORTED: XYZ in one block: a TNC 151 V has no straight lines "
      "of three axes at once");
}

// HD-239: X turned by 45 degrees is X and Y.
TEST(Tnc155Version, RefusesAThirdAxisThatARotationBringsInOnEAndV) {
  const Blocks turned{"TOOL CALL 0 Z S 100", "L X+0 Y+0 R0 F100", "CYCL DEF 10.0 ROTATION",
                      "CYCL DEF 10.1 ROT+45", "L X+10 Z+5"};
  EXPECT_EQ(alarm(turned, {}), "");
  EXPECT_EQ(alarm(turned, kTncE),
            "TNC-NOT-SUPPORTED 6 ! NOT SUPPORTED: XYZ move in this block: a TNC 155 E has no "
            "straight lines of three axes at once");
}

// HD-239
TEST(Tnc155Version, RefusesAHelixOnEAndVAndTakesTheCircle) {
  const auto turn = [](const std::string& axis) {
    return Blocks{"TOOL CALL 0 Z S 100", "CC X+0 Y+0", "L X+10 Y+0 R0 F100",
                  "CP IPA+360" + axis + " DR+"};
  };
  EXPECT_EQ(alarm(turn(""), kTncE), "");
  EXPECT_EQ(alarm(turn(" IZ+5"), {}), "");
  EXPECT_EQ(alarm(turn(" IZ+5"), kTncE),
            "TNC-NOT-SUPPORTED 5 ! NOT SUPPORTED: an arc with Z: a TNC 155 E has no helices");
}

// HD-238
TEST(Tnc155Version, KnowsG38FromSoftware08) {
  const std::string stop = "N10 G38*\n";
  EXPECT_EQ(iso_alarm(stop, software(8)), "");
  EXPECT_EQ(iso_alarm(stop, software(7)),
            "TNC-ILLEGAL-G 2 ! ILLEGAL G-CODE: G38: a TNC 155 A with software 07 has no G38 (from "
            "software 08)");
  EXPECT_EQ(alarm({"STOP M5"}, software(1)), "") << "plain language always had STOP";
}

// HD-238
TEST(Tnc155Version, KnowsTheTouchProbeFromSoftware06) {
  const Blocks plain{"TOOL CALL 0 Z S 100", "TCH PROBE 0.0 REF. PLANE Q5 Z-",
                     "TCH PROBE 0.1 X+10 Y+10 Z-20"};
  const std::string iso = "N10 G17 G40 G90*\nN20 G55 P01 5 P02 Z- P03 G90 X+10 Y+10 Z-20*\n";
  const std::string lacks =
      "a TNC 155 A with software 05 has no touch probe functions (from software 06)";
  EXPECT_EQ(alarm(plain, software(5)), "TNC-NOT-SUPPORTED 3 ! NOT SUPPORTED: TCH PROBE: " + lacks);
  EXPECT_EQ(iso_alarm(iso, software(5)), "TNC-ILLEGAL-G 3 ! ILLEGAL G-CODE: G55: " + lacks);
  const std::string surface = "[probe]\nsurface = [ { axis = \"Z\", at = -20.0 } ]\n";
  EXPECT_EQ(alarm(plain, control("software = 6\n", surface)), "");
  EXPECT_EQ(iso_alarm(iso, control("software = 6\n", surface)), "");
  EXPECT_EQ(alarm(plain, control("software = 1\nmodel = \"TNC 151 A\"\n", surface)), "");
}

// HD-238
TEST(Tnc155Version, KnowsTheNextToolFromSoftware02) {
  EXPECT_EQ(iso_alarm("N10 G51 T5*\n", software(2)), "");
  EXPECT_EQ(iso_alarm("N10 G51 T5*\n", software(1)),
            "TNC-ILLEGAL-G 2 ! ILLEGAL G-CODE: G51: a TNC 155 A with software 01 has no search for "
            "the next tool (from software 02)");
  EXPECT_EQ(alarm({"TOOL DEF 5"}, software(1)),
            "TNC-NOT-SUPPORTED 2 ! NOT SUPPORTED: TOOL DEF 5 without L and R: a TNC 155 A with "
            "software 01 has no search for the next tool (from software 02)");
  EXPECT_EQ(alarm({"TOOL DEF 5 L+0 R+2"}, software(1)), "");
}

// HD-238
TEST(Tnc155Version, TakesSpeedsAbove9000FromSoftware06) {
  EXPECT_EQ(alarm({"TOOL CALL 0 Z S 9000"}, software(5)), "");
  EXPECT_EQ(alarm({"TOOL CALL 0 Z S 12000"}, software(6)), "");
  EXPECT_EQ(
      alarm({"TOOL CALL 0 Z S 12000"}, software(5)),
      "TNC-WRONG-RPM 2 ! WRONG RPM: S 12000: a TNC 155 A with software 05 has no speeds above "
      "9000 (from software 06)");
  EXPECT_EQ(iso_alarm("N10 G17 S12000*\n", software(5)).substr(0, 28),
            "TNC-WRONG-RPM 2 ! WRONG RPM:");
}

// HD-238, HD-089: 30 mm and 40 degrees at F100; before software 03 the axis rotates at 100.
TEST(Tnc155Version, SplitsTheFeedWithARotaryAxisFromSoftware03) {
  const Blocks turn{"TOOL CALL 0 Z S 100", "L X+30 C+40 R0 F100"};
  EXPECT_EQ(moves_of(turn, software(3)), Blocks{"L X30 C40 F60"});
  EXPECT_EQ(moves_of(turn, software(2)), Blocks{"L X30 C40 F75"});
  EXPECT_EQ(moves_of(turn, control("software = 2\nmodel = \"TNC 151 A\"")),
            Blocks{"L X30 C40 F60"});
}

// HD-239: a TNC 151 draws nothing; its program runs all the same.
TEST(Tnc155Version, WarnsOfABlankOnATnc151) {
  const Blocks blank{"DEF BLK FORM MIN X+0 Y+0 Z-20", "DEF BLK FORM MAX X+100 Y+80 Z+0"};
  const auto on_151 = run_blocks(blank, control("model = \"TNC 151 P\""));
  EXPECT_EQ(on_151.events.at(0), "warning TNC-NO-GRAPHICS");
  EXPECT_EQ(on_151.events.back(), "end 4");
  EXPECT_EQ(run_blocks(blank, control("model = \"TNC 155 P\"")).events.size(),
            on_151.events.size() - 1);
}

// HD-238: what a block asks for is reported where the run comes to it, also in a called program.
TEST(Tnc155Version, TellsTheLineOfACalledProgram) {
  PathSetup setup = software(5);
  setup.programs = {{"7", "0 BEGIN PGM 7 MM\n1 CC X+0\n2 TOOL CALL 0 Z S 12000\n3 END PGM 7 MM\n"}};
  EXPECT_EQ(run_blocks({"CALL PGM 7"}, setup).alarm_line, 3u);
}

}  // namespace
}  // namespace dripline::interpreter
