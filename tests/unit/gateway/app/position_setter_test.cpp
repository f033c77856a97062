// Datum set and playback: from where the axes rest, by each control's rules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/gateway/app/position_fixture.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct DatumCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string setup, move;  ///< moves the axes by MDI
  std::string set, effect;  ///< what is set, and what it does
  std::string program;      ///< runs then; axis `axis` is at `ends`
  std::size_t axis;
  double ends;
};
void PrintTo(const DatumCase& shown, std::ostream* out) {
  *out << shown.name;
}
class Datum : public testing::TestWithParam<DatumCase> {};

// CEN-222, HD-076. The next program moves by the datum that was set.
TEST_P(Datum, OfThePositionIsInForceForTheNextProgram) {
  const DatumCase& given = GetParam();
  Shop shop(given.control, given.setup);
  ASSERT_EQ(shop.mdi(given.move), "completed");
  const auto before = shop.gateway->status().position;
  (void)shop.memory_records();
  EXPECT_THAT(shop.set(given.set), StartsWith(given.effect + " ("));
  EXPECT_EQ(shop.gateway->status().position, before) << "nothing moves";
  const auto reports = shop.memory_records();
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].run, "set-" + shop.last_id());
  EXPECT_EQ(reports[1].run, "set-" + shop.last_id());
  const auto change = nlohmann::json::parse(reports[1].text)["change"];
  EXPECT_EQ(change["what"], given.set);
  EXPECT_EQ(change["by"], "anna");
  shop.restart_gateway();  // as after a kill: it is kept
  EXPECT_EQ(shop.run(given.program), "completed");
  EXPECT_NEAR(shop.at(given.axis), given.ends, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    , Datum,
    testing::Values(
        DatumCase{"fanuc", interpreter::kFanucDialect,
                  "[[offset]]\nname = \"G54\"\nX = 100.0\n[[offset]]\nname = \"EXT\"\nX = 3.0\n",
                  "G21 G91 G1 X50. F5000\n", "datum G54 X 7.5 mm",
                  "G54.X is 39.500 mm, it was 100.000", "O1\nG21 G90 G54 G0 X7.5\nM30\n", 0, 50},
        DatumCase{"fanuc_in_inches", interpreter::kFanucDialect, "", "G21 G91 G1 X50.8 F5000\n",
                  "datum G55 X 1 in", "G55.X is 25.400 mm, it was 0.000",
                  "O1\nG20 G90 G55 G0 X1.\nM30\n", 0, 50.8},
        DatumCase{"fanuc_page", interpreter::kFanucDialect, "", "G21 G91 G1 Z-20. F5000\n",
                  "datum G54.1P7 Z 5 mm", "G54.1P7.Z is -25.000 mm, it was 0.000",
                  "O1\nG21 G90 G54.1P7 G0 Z5.\nM30\n", 2, -20},
        DatumCase{"fanuc_lathe_diameter", interpreter::kFanucLatheDialect, "",
                  "G98 G1 U80. F5000\n", "datum G54 X 30 mm", "G54.X is 25.000 mm, it was 0.000",
                  "O1\nG54 G0 X30.\nM30\n", 0, 40},
        DatumCase{"rs274ngc_in_inches", interpreter::kRs274NgcDialect, "units = \"in\"\n",
                  "G20 G91 G1 X2 F500\n", "datum G54 X 0.5 in", "#5221 is 1.5000 in, it was 0.0000",
                  "G20 G90 G54 G0 X0.5\nM2\n", 0, 50.8},
        DatumCase{"rs274ngc_other_system", interpreter::kRs274NgcDialect, "",
                  "G21 G91 G1 Y30 F5000\n", "datum G59.3 Y -1 mm",
                  "#5382 is 31.000 mm, it was 0.000", "G21 G90 G59.3 G0 Y-1\nM2\n", 1, 30},
        DatumCase{"centurion_zero", interpreter::kCenturionDialect, "units = \"mm\"\n",
                  "G21 G91 G98 G1 Z-10 F5000\n", "datum G54 Z 0 mm",
                  "P500 is -10.000 mm, it was 0.000", "O1\nG21 G98 G54 G0 Z2\nM30\n", 2, -8},
        DatumCase{"centurion_in_inches", interpreter::kCenturionDialect, "",
                  "G20 G91 G98 G1 Z-2 F50\n", "datum G55 Z 0 mm",
                  "P502 is -2.0000 in, it was 0.0000", "O1\nG20 G98 G55 G0 Z0\nM30\n", 2, -50.8},
        DatumCase{"tnc155", interpreter::kTnc155Dialect, "[[offset]]\nname = \"datum\"\nX = 9.0\n",
                  "X+31 R0 F9000\n", "datum X 40 mm", "datum.X is 0.000 mm, it was 9.000",
                  "BEGIN PGM 1 MM\nL X+41 R0 F9000\nEND PGM 1 MM\n", 0, 41}),
    [](const auto& i) { return i.param.name; });

struct RefusalCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string setup, set, why;
};
void PrintTo(const RefusalCase& shown, std::ostream* out) {
  *out << shown.name;
}
class PositionRefusal : public testing::TestWithParam<RefusalCase> {};

TEST_P(PositionRefusal, NamesTheReasonAndChangesNothing) {
  const RefusalCase& given = GetParam();
  Shop shop(given.control, given.setup);
  EXPECT_THAT(shop.set(given.set), AllOf(StartsWith("refused: "), HasSubstr(given.why)));
  EXPECT_TRUE(shop.memory_records().empty());
}

INSTANTIATE_TEST_SUITE_P(
    , PositionRefusal,
    testing::Values(
        RefusalCase{"no_such_axis", interpreter::kFanucLatheDialect, "", "datum G54 Y 0 mm",
                    "this machine has no axis Y"},
        RefusalCase{"x_as_radius", interpreter::kFanucLatheDialect,
                    "[control]\nx_is_diameter = false\n", "datum G54 X 0 mm", "x_is_diameter"},
        RefusalCase{"no_such_offset", interpreter::kFanucDialect, "", "datum G60 X 0 mm",
                    "no work offset 'G60'"},
        RefusalCase{"ext_is_no_datum", interpreter::kFanucDialect, "", "datum EXT X 0 mm",
                    "no work offset 'EXT'"},
        RefusalCase{"no_such_page", interpreter::kFanucDialect, "", "datum G54.1P49 X 0 mm",
                    "no work offset 'G54.1P49'"},
        RefusalCase{"no_such_tool", interpreter::kFanucDialect, "", "tool 500 Z 0 mm G54",
                    "no tool offset 500"},
        RefusalCase{"length_along_x_of_a_mill", interpreter::kFanucDialect, "", "tool 3 X 0 mm G54",
                    "along Z alone, not X"},
        RefusalCase{"beyond_the_limit", interpreter::kFanucDialect, "", "tool 3 Z -1000 mm G54",
                    "tool.3.length would be 1000.0000: the control takes -999.999 to 999.999"},
        RefusalCase{"datum_beyond_the_limit", interpreter::kFanucDialect, "",
                    "datum G54 X 100000 mm", "the control takes -99999.999 to 99999.999"},
        RefusalCase{"centurion_datum_x", interpreter::kCenturionDialect, "", "datum G54 X 0 mm",
                    "along Z alone, not X"},
        RefusalCase{"centurion_datum_not_zero", interpreter::kCenturionDialect, "",
                    "datum G54 Z 1 mm", "the value is 0"},
        RefusalCase{"centurion_tool", interpreter::kCenturionDialect, "", "tool 25 Z 0 mm G54",
                    "no tool offset 25: 1 to 24"},
        RefusalCase{"centurion_floating_zero", interpreter::kCenturionDialect,
                    "[[offset]]\nname = \"G50\"\nZ = 1.0\n", "datum G54 Z 0 mm", "shift"},
        RefusalCase{"tnc_has_one_datum", interpreter::kTnc155Dialect, "", "datum G54 X 0 mm",
                    "one datum, and no 'G54'"},
        RefusalCase{"tnc_length_is_text", interpreter::kTnc155Dialect, "", "tool 3 Z 0 mm",
                    "control tnc155 sets no length of a tool"},
        RefusalCase{"tnc_basic_rotation", interpreter::kTnc155Dialect,
                    "[control]\nbasic_rotation = 5.0\n", "datum X 0 mm", "a basic rotation"},
        RefusalCase{"ngc_rotated", interpreter::kRs274NgcDialect,
                    "[control]\nprofile = \"linuxcnc\"\n[[variable]]\nname = \"#5230\"\nvalue = "
                    "30.0\n",
                    "datum G54 X 0 mm", "rotat"},
        RefusalCase{"ngc_unknown_tool", interpreter::kRs274NgcDialect, "", "tool 9 Z 0 mm G54",
                    "no tool 9 in its tool table"},
        RefusalCase{"tektronix", interpreter::kTektronix1704Dialect, "", "datum X 0 mm",
                    "control tektronix-1704 sets no datum"},
        RefusalCase{"prototrak", interpreter::kProtoTrakDialect, "", "datum X 0 mm",
                    "control prototrak-plus sets no datum"},
        RefusalCase{"not_understood", interpreter::kFanucDialect, "", "datum G54 X nan mm",
                    "expected 'datum G54 X 12.5 mm'"}),
    [](const auto& i) { return i.param.name; });

TEST(PositionSetter, ChangesNothingWhileAProgramRunsOrWaits) {
  Shop shop(interpreter::kFanucDialect, "", "1x");
  shop.push("1", "O1\nG21 G90 G1 X10. F1000\nM00\nM30\n");
  ASSERT_TRUE(shop.start("1").accepted);
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), HasSubstr("run run-1 is active"));
  ASSERT_TRUE(shop.run_until(
      [&] { return shop.gateway->status().execution == dds::Execution::ProgramStopped; }));
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), HasSubstr("run run-1 is active"));
  EXPECT_TRUE(shop.memory_records().empty());
}

TEST(PositionSetter, IsRefusedWithTheEmergencyStopAndWithoutConsent) {
  Shop shop(interpreter::kFanucDialect);
  EXPECT_EQ(shop.panel("emergency-stop on"), "ok");
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), HasSubstr("emergency stop"));
  EXPECT_EQ(shop.panel("emergency-stop off"), "ok");
  shop.make_attended();
  shop.restart_gateway();
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), HasSubstr("remote enable"));
  EXPECT_EQ(shop.panel("remote-enable on"), "ok");
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), StartsWith("G54.X is 0.000 mm, it was 0.000"));
}

TEST(PositionSetter, RefusesWhereTheLastTextHasLeftAShift) {
  Shop shop(interpreter::kFanucDialect);
  ASSERT_EQ(shop.mdi("G21 G90 G92 X50.\n"), "completed");
  EXPECT_THAT(shop.set("datum G54 X 0 mm"),
              AllOf(HasSubstr("a shift"), HasSubstr("since the last program")));
  EXPECT_TRUE(shop.memory_records().empty());
  Shop lathe(interpreter::kCenturionDialect, "units = \"mm\"\n");
  ASSERT_EQ(lathe.mdi("G21 G98 G0 X10. Z5.\n"), "completed");
  ASSERT_EQ(lathe.mdi("G52 X5. Z7.\n"), "completed");
  EXPECT_THAT(lathe.set("tool 3 Z 0 mm G54"), HasSubstr("a shift (G50, G52)"));
  ASSERT_EQ(lathe.mdi("G52 X0 Z0\n"), "completed");
  EXPECT_THAT(lathe.set("tool 3 Z 0 mm G54"), testing::Not(HasSubstr("a shift")));
}

// A repeated command, as after a lost answer, sets nothing twice.
TEST(PositionSetter, CarriesACommandOutOnce) {
  Shop shop(interpreter::kFanucDialect);
  dds::Command command = shop.command(CommandAction::SetPosition);
  command.run.clear();
  command.argument = "datum G54 X 1 mm";
  EXPECT_THAT(shop.send(command).reason, StartsWith("G54.X is -1.000 mm, it was 0.000"));
  EXPECT_THAT(shop.send(command).reason, StartsWith("G54.X is -1.000 mm, it was 0.000"));
  EXPECT_EQ(shop.memory_records().size(), 2U) << "one report, of two parts";
}

// The setup of the server is the base: a later change of it there wins, as after a program.
TEST(PositionSetter, YieldsToALaterChangeOfTheSetup) {
  Shop shop(interpreter::kFanucDialect);
  shop.server_setup = "[[offset]]\nname = \"G54\"\nX = 10.0\n";
  EXPECT_THAT(shop.set("datum G54 X 1 mm"), StartsWith("G54.X is -1.000 mm, it was 10.000"));
  EXPECT_EQ(shop.run("O1\nG21 G90 G54 G0 X0\nM30\n"), "completed");
  EXPECT_EQ(shop.at(0), -1);
  shop.server_setup = "[[offset]]\nname = \"G54\"\nX = 20.0\n";
  EXPECT_EQ(shop.run("O1\nG21 G90 G54 G0 X0\nM30\n"), "completed");
  EXPECT_EQ(shop.at(0), 20);
}

TEST(PositionSetter, IsRefusedByAFullDiskAndTheLastOneKeptIsInForce) {
  Shop shop(interpreter::kFanucDialect);
  shop.outbox_bytes = 160 * 1024;
  shop.acknowledges = false;
  shop.restart_gateway();
  int kept = 0;
  std::string answer;
  while (kept < 5000) {
    answer = shop.set(fmt::format("datum G54 X {} mm", kept + 1));
    if (answer.starts_with("refused: ")) break;
    ++kept;
  }
  ASSERT_GT(kept, 0);
  EXPECT_THAT(answer, HasSubstr("cannot be kept"));
  EXPECT_THAT(shop.set("datum G54 X 9999 mm"), HasSubstr("cannot be kept")) << "nor now";
  shop.outbox_bytes = 4ULL << 30;
  shop.acknowledges = true;
  shop.restart_gateway();
  EXPECT_EQ(shop.run("O1\nG21 G90 G54 G0 X0\nM30\n"), "completed");
  EXPECT_EQ(shop.at(0), -kept);
}

TEST(Playback, IsTheWordsOfABlockInCoordinatesOfTheDatum) {
  Shop shop(interpreter::kTnc155Dialect, "[[offset]]\nname = \"datum\"\nX = 10.0\n");
  ASSERT_EQ(shop.mdi("X+31 R0 F9000\n"), "completed");
  ASSERT_EQ(shop.mdi("Y-2.5 R0 F9000\n"), "completed");
  EXPECT_EQ(shop.playback("X"), "X+31.000 R0");
  EXPECT_EQ(shop.playback("XY"), "L X+31.000 Y-2.500 R0");
  EXPECT_THAT(shop.set("datum X 0 mm"), StartsWith("datum.X is 41.000 mm, it was 10.000"));
  EXPECT_EQ(shop.playback("XYZ"), "L X+0.000 Y-2.500 Z+0.000 R0");
  EXPECT_THAT(shop.playback("XX"), HasSubstr("each once"));
  EXPECT_THAT(shop.playback("U"), HasSubstr("this machine has no axis U"));
  EXPECT_THAT(shop.playback("A"), HasSubstr("this machine has no axis A")) << "nor its control";
  EXPECT_THAT(shop.set("datum A 0 deg"), HasSubstr("this machine has no axis A"));
  Shop fanuc(interpreter::kFanucDialect);
  EXPECT_THAT(fanuc.playback("X"), HasSubstr("takes no position into a program"));
}

// The block that it gives brings the axes back to where they were.
TEST(Playback, ReadsBackAsABlock) {
  Shop shop(interpreter::kTnc155Dialect, "[[offset]]\nname = \"datum\"\nX = 10.0\n");
  ASSERT_EQ(shop.mdi("X+31.25 R0 F9000\n"), "completed");
  const std::string block = shop.playback("XY");
  EXPECT_EQ(shop.run("BEGIN PGM 1 MM\nL X+0 R0 F9000\n" + block + " F9000\nEND PGM 1 MM\n"),
            "completed");
  EXPECT_NEAR(shop.at(0), 41.25, 1e-9);
}

// G92 of RS274/NGC is kept in its parameters: the setup has none.
TEST(PositionSetter, SaysWhetherSetupOrMemoryHasWhatStandsAgainstIt) {
  Shop shop(interpreter::kRs274NgcDialect, "[control]\nprofile = \"linuxcnc\"\n");
  ASSERT_EQ(shop.run("G21\nG92 X5\nM2\n"), "completed");
  shop.restart_gateway();
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), AllOf(HasSubstr("the control's memory has kept it"),
                                                  Not(HasSubstr("out of the setup"))));
  Shop other(interpreter::kRs274NgcDialect, "[[offset]]\nname = \"G92\"\nX = 5.0\n");
  EXPECT_THAT(other.set("datum G54 X 0 mm"), HasSubstr("take it out of the setup first"));
}

/// HD-082: the screen of a control at rest shows what playback takes over.
TEST(ScreenAtRest, ShowsThePositionFromTheDatum) {
  Shop shop(interpreter::kTnc155Dialect);
  ASSERT_TRUE(shop.run_until([&] { return shop.status.has_value(); }));
  EXPECT_FALSE(shop.gateway->status().coordinates->program) << "the server's setup is not known";
  (void)shop.ask(dds::CommandAction::Query, "");
  ASSERT_TRUE(shop.gateway->status().coordinates->program);
  EXPECT_EQ(shop.gateway->status().coordinates->program->position[0], shop.at(0));
  ASSERT_THAT(shop.set("datum X 40 mm"), Not(StartsWith("refused")));
  ASSERT_TRUE(shop.gateway->status().coordinates->program);
  EXPECT_NEAR(shop.gateway->status().coordinates->program->position[0], 40, 1e-9);
  EXPECT_EQ(shop.playback("X"), "X+40.000 R0");
  ASSERT_EQ(shop.mdi("X+50 R0 F9000\n"), "completed");
  ASSERT_TRUE(shop.gateway->status().coordinates->program);
  EXPECT_NEAR(shop.gateway->status().coordinates->program->position[0], 50, 1e-9)
      << "also after the end of a program";
}

/// HD-081: MOD functions take effect when the server has them, not at the next start.
TEST(ScreenAtRest, FollowsTheModFunctionsAtOnce) {
  Shop shop(interpreter::kTnc155Dialect);
  EXPECT_FALSE(shop.gateway->status().screen->is_inch);
  shop.server_setup = "[control]\nposition_display = \"REF\"\ndisplay_units = \"inch\"\n";
  (void)shop.ask(dds::CommandAction::Query, "");
  EXPECT_EQ(shop.gateway->status().screen->position, dds::PositionDisplay::Reference);
  EXPECT_TRUE(shop.gateway->status().screen->is_inch);
  shop.server_setup = "wrong";
  (void)shop.ask(dds::CommandAction::Query, "");
  EXPECT_EQ(shop.gateway->status().screen->position, dds::PositionDisplay::Reference);
}

}  // namespace
}  // namespace dripline::gateway
