#include "gateway/line/heads/modal_scan.hpp"

#include <gtest/gtest.h>
#include <algorithm>

namespace dripline::line {
namespace {

/// A program cut where a run begins, and what is found out about it.
struct ModalCase {
  const char* name;
  const char* control;
  std::vector<const char*> skipped, rest;
  const char* words;  ///< as words_text has them
  const char* head = nullptr;
};

class ModalScanTest : public testing::TestWithParam<ModalCase> {};

TEST_P(ModalScanTest, NamesWhatTheRestReliesOn) {
  ModalScan scan(GetParam().control);
  for (const auto* block : GetParam().skipped) scan.skip(block);
  bool is_decided = false;
  for (const auto* block : GetParam().rest) is_decided = is_decided || !scan.look(block);
  if (!is_decided) scan.end();
  EXPECT_EQ(words_text(scan.relied_on()), GetParam().words);
  if (GetParam().head == nullptr) return;
  EXPECT_EQ(head_text(scan.relied_on()), GetParam().head);
}

INSTANTIATE_TEST_SUITE_P(
    , ModalScanTest,
    testing::Values(
        ModalCase{"nothing_in_force", "fanuc", {"%", "O1", "(G21)"}, {"G1X1."}, "", ""},
        ModalCase{"said_again", "fanuc", {"G21G90G1F100"}, {"G20 G91", "G0 X1.", "G1 X2. F50"}, ""},
        ModalCase{"units_and_distance",
                  "fanuc",
                  {"G21", "G91"},
                  {"G1 X1. F5"},
                  "G21 (line 1), G91 (line 2)",
                  "G21\nG91\n"},
        ModalCase{"the_last_one_counts", "fanuc", {"G90", "G91", "G90"}, {"G0X1."}, "G90 (line 3)"},
        ModalCase{"feed_by_the_first_feed_move", "fanuc", {"F100"}, {"G0X1.", "G1X2.F5"}, ""},
        ModalCase{"feed_of_a_later_move", "fanuc", {"F100"}, {"G0X1.", "G1X2."}, "F100 (line 1)"},
        ModalCase{"no_move_needs_it", "fanuc", {"G21 F100"}, {"M30"}, ""},
        ModalCase{"motion", "fanuc", {"G2"}, {"X1.Y1.R5."}, "G2 (line 1)"},
        ModalCase{"tool_and_spindle",
                  "fanuc",
                  {"T2", "M6", "S800 M3", "M8"},
                  {"G1 X1. F5"},
                  "T2 M6 (line 2), S800 (line 3), M3 (line 3), M8 (line 4)",
                  "T2 M6\nS800 M3\nM8\n"},
        ModalCase{"next_tool", "fanuc", {"T2 M6", "T3"}, {"M6", "G1X1.F5"}, "T3 (line 2)"},
        ModalCase{"tool_changed_in_the_rest", "fanuc", {"T2 M6", "T3"}, {"T4 M6", "G1X1.F5"}, ""},
        ModalCase{
            "work_offset_with_its_page", "fanuc", {"G54.1 P3"}, {"G0X1."}, "G54.1 P3 (line 1)"},
        ModalCase{"length_with_its_offset", "fanuc", {"G43 H2 Z5."}, {"G0X1."}, "G43 H2 (line 1)"},
        ModalCase{"rotation_as_its_block",
                  "fanuc",
                  {"N7 G68 X0 Y0 R30."},
                  {"G0X1."},
                  "G68 X0 Y0 R30. (line 1)",
                  "G68 X0 Y0 R30.\n"},
        ModalCase{"cycle", "fanuc", {"G81 X0 Z-5. R1. F50"}, {"X5."}, "G81 (line 1), F50 (line 1)"},
        ModalCase{
            "cycle_canceled", "fanuc", {"G81 Z-5. R1. F50", "G80"}, {"G0 X5.", "G1X6.F2"}, ""},
        ModalCase{"call_and_variable",
                  "fanuc",
                  {"M98 P100", "#1=5", "N3 IF[#1 GT 2]GOTO 9"},
                  {"X1."},
                  "M98 P100 (line 1), #1=5 (line 2), N3 IF[#1 GT 2]GOTO 9 (line 3)"},
        ModalCase{
            "prints_change_nothing", "fanuc", {"POPEN", "DPRNT[X#1[44]]", "PCLOS"}, {"X1."}, ""},
        ModalCase{"tektronix_arcs_are_no_units",
                  "tektronix-1704",
                  {"N001G20X1000I500"},
                  {"N002X2000"},
                  "G20 (line 1)"},
        ModalCase{
            "look_ahead", "fanuc", {"G8 P1", "G5.1 Q1"}, {"X1."}, "G5.1 Q1 (line 2)", "G5.1 Q1\n"},
        ModalCase{"speed_limit_beside_the_speed",
                  "fanuc-t",
                  {"G50 S2000", "G96 S150 M3"},
                  {"G1 X1. F.2"},
                  "G50 S2000 (line 1), G96 S150 (line 2), S150 (line 2), M3 (line 2)",
                  "G50 S2000\nG96 S150 M3\n"},
        ModalCase{"speed_limit_of_g92",
                  "fanuc-t",
                  {"G92 S2000", "G92 S1500"},
                  {"G1 X1."},
                  "G92 S1500 (line 2)"},
        ModalCase{"local_system_axis_by_axis",
                  "fanuc",
                  {"G52 X10.", "G52 Y5."},
                  {"G0 X1."},
                  "G52 X10. G52 Y5. (line 2)",
                  "G52 X10.\nG52 Y5.\n"},
        ModalCase{"mirrors_axis_by_axis",
                  "fanuc",
                  {"G51.1 X0", "G51.1 Y0", "G50.1 X0"},
                  {"G0 X1."},
                  "G51.1 X0 G51.1 Y0 G50.1 X0 (line 3)",
                  "G51.1 X0\nG51.1 Y0\nG50.1 X0\n"},
        ModalCase{"a_further_axis_does_not_end_a_mirror",
                  "fanuc",
                  {"G51.1 X0"},
                  {"G51.1 Y0", "G0 X1."},
                  "G51.1 X0 (line 1)"},
        ModalCase{"limit_of_g96",
                  "rs274ngc",
                  {"G96 D2500 S150"},
                  {"G1X1."},
                  "G96 D2500 S150 (line 1), S150 (line 1)",
                  "G96 D2500 S150\n"},
        ModalCase{"flood_and_mist", "fanuc", {"M8", "M7"}, {"G1X1."}, "M8 (line 1), M7 (line 2)"},
        ModalCase{"coolants_off", "fanuc", {"M8", "M7", "M9"}, {"G1X1."}, "M9 (line 3)"},
        ModalCase{"mist_in_the_rest", "fanuc", {"M8"}, {"M7", "G1X1."}, "M8 (line 1)"},
        ModalCase{"diameter", "rs274ngc", {"G7"}, {"X1."}, "G7 (line 1)"},
        ModalCase{"prototrak_header",
                  "prototrak-plus",
                  {"PN7 G21 ;", "G91 ;", "N1 G101 XB0A YB0A XE1. YE1. F5.0 T2 TC1 ;"},
                  {"N2 G101 XB1. YB1. XE2. YE2. F5.0 T2 TC1 ;"},
                  "PN7 G21 ; G91 ; (line 2)",
                  "PN7 G21 ;\nG91 ;\n"},
        ModalCase{
            "prototrak_events_build_on_the_one_before",
            "prototrak-plus",
            {"PN7 G21 ;", "N1 G101 XB0A YB0A XE1. YE1. F5.0 T2 TC1 ;"},
            {"N2 G101 XE2. YE2. ;"},
            "PN7 G21 ; (line 1), T2 (line 2), the end of the event, where the next one begins "
            "(line 2), TC1 (line 2), F5.0 (line 2)"},
        ModalCase{"tnc",
                  "tnc155",
                  {"0 BEGIN PGM 15 MM", "1 TOOL CALL 2 Z S800", "2 L X+1 R0 F200 M3"},
                  {"3 L X+2 R F M"},
                  "BEGIN PGM 15 MM (line 1), TOOL CALL 2 Z S800 (line 2), R0 (line 3), F200 (line "
                  "3), M3 (line 3)"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(ModalScan, KnowsWhatCannotBeSentByItself) {
  ModalScan scan("fanuc");
  scan.skip("G21");
  scan.skip("G41 D1");
  scan.skip("G92 X0");
  scan.look("G1 X1. F5");
  const auto words = scan.relied_on();
  ASSERT_EQ(words.size(), 3u);
  EXPECT_TRUE(words[0].can_be_sent);
  EXPECT_FALSE(words[1].can_be_sent);
  EXPECT_FALSE(words[2].can_be_sent);
}

struct UnsendableCase {
  const char* name;
  const char* control;
  const char* block;
};

class UnsendableTest : public testing::TestWithParam<UnsendableCase> {};

TEST_P(UnsendableTest, IsNamedAndNotSentAgain) {
  ModalScan scan(GetParam().control);
  scan.skip("X30. Y40.");
  scan.skip(GetParam().block);
  scan.look("X1. F5");
  const auto words = scan.relied_on();
  EXPECT_TRUE(std::ranges::any_of(words, [](const ModalWord& word) {
    return word.line == 2 && !word.can_be_sent;
  })) << words_text(words);
}

INSTANTIATE_TEST_SUITE_P(
    , UnsendableTest,
    testing::Values(UnsendableCase{"tilted_plane", "fanuc", "G68.2 X0 Y0 Z0 I0 J30. K0"},
                    UnsendableCase{"tip_control", "fanuc", "G43.4 H1"},
                    UnsendableCase{"polar_interpolation", "fanuc", "G12.1"},
                    UnsendableCase{"cylinder", "fanuc", "G7.1 C20."},
                    UnsendableCase{"preset_of_a_lathe", "fanuc-t", "G50 X200. Z100."},
                    UnsendableCase{"preset_with_a_limit", "fanuc-t", "G50 X200. Z100. S2000"},
                    UnsendableCase{"preset_of_a_centurion", "centurion", "G50 X2. Z3."},
                    UnsendableCase{"mirror_of_a_centurion", "centurion", "G511 X0"},
                    UnsendableCase{"local_system_of_a_centurion", "centurion", "G12"},
                    UnsendableCase{"rotation_without_center", "fanuc", "G68 R45."},
                    UnsendableCase{"rotation_in_space", "fanuc", "G68 X0 Y0 I1 J0 K0 R45."},
                    UnsendableCase{"scaling_without_center", "fanuc", "G51 P2000"},
                    UnsendableCase{"rigid_tapping", "fanuc", "M29 S500"},
                    UnsendableCase{"length_on_length", "rs274ngc", "G43.2 H2"},
                    UnsendableCase{"tool_without_a_change", "rs274ngc", "M61 Q4"},
                    UnsendableCase{"feed_override_locked", "rs274ngc", "M50 P0"},
                    UnsendableCase{"length_of_another_control", "fanuc", "G43.1 Z5."},
                    UnsendableCase{"polar_coordinates", "fanuc", "G16"},
                    UnsendableCase{"stroke_zone", "fanuc", "G22 X1. Y1. Z1. I0 J0 K0"},
                    UnsendableCase{"zero_of_a_tektronix", "tektronix-1704", "N3G94X0"},
                    UnsendableCase{"turning_cycle", "fanuc-t", "G90 X30. Z-20. F.2"},
                    UnsendableCase{"facing_cycle", "fanuc-t", "G94 X30. Z-20. F.2"},
                    UnsendableCase{"turning_cycle_of_system_b", "fanuc-t", "G77 X30. Z-20. F.2"},
                    UnsendableCase{"skipped_by_the_panel", "fanuc", "/G20"},
                    UnsendableCase{"skipped_by_the_panel_with_a_number", "fanuc", "N7 /2 G20"},
                    UnsendableCase{"restored_modes", "rs274ngc", "M72"},
                    UnsendableCase{"unknown_code", "fanuc", "G123"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(ModalScan, AThreadGoesOnAsAThread) {
  ModalScan scan("fanuc-t");
  for (const char* block : {"G97 S500 M3", "G0 X20. Z5.", "G32 Z-5. F2."}) scan.skip(block);
  scan.look("Z-10.");
  EXPECT_EQ(words_text(scan.relied_on()),
            "G97 S500 (line 1), S500 (line 1), M3 (line 1), G32 (line 3), F2. (line 3)");
}

TEST(ModalScan, NothingStaysOfCodesOfOneBlock) {
  ModalScan fanuc("fanuc");
  for (const char* block : {"G28 Z0", "G4 P500", "G53 X0", "G9 X1.", "G31 X5.", "G30 Z0"})
    fanuc.skip(block);
  fanuc.look("G1 X1.");
  EXPECT_EQ(words_text(fanuc.relied_on()), "");
  ModalScan centurion("centurion");
  for (const char* block : {"G28 X0", "G4 X1", "G90 X1 Z2", "G76 X1 Z2", "G45"})
    centurion.skip(block);
  centurion.look("G1 X1.");
  EXPECT_EQ(words_text(centurion.relied_on()), "");
}

TEST(ModalScan, ALengthByItsNumberAloneIsNotSent) {
  ModalScan scan("fanuc");
  for (const char* block : {"G43 H2 Z5.", "X1.", "H3"}) scan.skip(block);
  scan.look("G0 X1.");
  ASSERT_EQ(words_text(scan.relied_on()), "G43 H2 H3 (line 3)");
  EXPECT_FALSE(scan.relied_on().front().can_be_sent);
}

/// More blocks than are kept.
TEST(ModalScan, ALongChainOfLocalSystemsIsNotSent) {
  ModalScan scan("fanuc");
  for (int i = 0; i < 40; ++i) scan.skip("G52 X1.");
  scan.look("G1 X1.");
  ASSERT_EQ(scan.relied_on().size(), 1u);
  EXPECT_FALSE(scan.relied_on().front().can_be_sent);
}

}  // namespace
}  // namespace dripline::line
