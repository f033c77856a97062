#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// Bad words of the drilling and grooving cycles are reported before anything moves (CEN-120,
/// CEN-129, CEN-130, CEN-133).

/// Bad text becomes an alarm with a place, and nothing is executed after it.

namespace dripline::interpreter::centurion {

namespace {

struct CycleCase {
  std::string name;
  std::string block;
  std::string verdict;  ///< id and line:column
};

class CycleRefusal : public testing::TestWithParam<CycleCase> {};

TEST_P(CycleRefusal, ComesBeforeTheFirstMove) {
  ProgramRun run("G97 G99 S500 M3\n" + GetParam().block + "\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with(GetParam().verdict + " ")) << run.alarm();
  EXPECT_TRUE(run.events("rapid").empty());
  EXPECT_TRUE(run.events("line").empty());
}

INSTANTIATE_TEST_SUITE_P(
    , CycleRefusal,
    testing::Values(
        CycleCase{"x_is_no_word_of_a_hole", "G81 X1 R.1 Z-1", "CEN0501 2:5"},
        CycleCase{"two_cycles", "G81 G82 R.1 Z-1", "CEN0518 2:5"},
        CycleCase{"probe_in_a_cycle", "PROBE1 G81 R.1 Z-1", "CEN0518 2:12"},
        CycleCase{"too_deep", "G81 R.1 Z-100000", "CEN0544 2:5"},
        CycleCase{"dwell_negative", "G82 R.1 Z-1 P-1", "CEN0539 2:13"},
        CycleCase{"dwell_too_long", "G89 R.1 Z-1 P10000", "CEN0539 2:13"},
        CycleCase{"pecks_upwards", "G83 R-1 Z1 Q.1", "CEN0517 2:0"},
        CycleCase{"pecks_of_nothing", "G83 R.1 Z-1 Q0", "CEN0517 2:13"},
        CycleCase{"pecks_never_given", "G83 R.1 Z-1", "CEN0517 2:0"},
        CycleCase{"peck_with_sign", "G83 R.1 Z-1 Q-.1", "CEN0517 2:13"},
        CycleCase{"peck_clearance_with_sign", "G83 R.1 Z-1 Q.1 E-.1", "CEN0517 2:17"},
        CycleCase{"first_depth_above", "G83 R.1 Z-1 Q.1 V.2", "CEN0517 2:17"},
        CycleCase{"too_many_pecks", "G83 R.1 Z-99 Q.01", "CEN1007 2:0"},
        CycleCase{"pecks_of_nothing_with_clearance", "G83 R.1 Z-99 Q0E1", "CEN0517 2:14"},
        CycleCase{"tap_per_minute", "G98 F9 G84 R.1 Z-1", "CEN0518 2:0"},
        CycleCase{"tap_at_surface_speed", "G96 S300 G84 R.1 Z-1", "CEN0518 2:0"},
        CycleCase{"tap_standing", "M5\nG84 R.1 Z-1", "CEN0518 3:0"},
        CycleCase{"groove_without_step", "G74 R.1 Z-1 Q.1 X1", "CEN0517 2:0"},
        CycleCase{"groove_without_depth", "G74 R.1 Z.1 Q.1", "CEN0517 2:9"},
        CycleCase{"groove_of_many_columns", "G74 R.1 Z-1 Q.1 X90 I.001", "CEN1007 2:0"},
        CycleCase{"stock_wider_than_groove", "G74 R.1 Z-1 Q.1 X1 I.1 A.3", "CEN0517 2:24"},
        CycleCase{"stock_deeper_than_groove", "G74 R.1 Z-1 Q.1 X1 I.1 C1.1", "CEN0517 2:24"},
        CycleCase{"stock_without_width", "G75 R3 X2 Q.1 C.01", "CEN0517 2:15"},
        CycleCase{"negative_stock", "G75 R3 X2 Q.1 Z-1 K.1 A-.1", "CEN0517 2:23"},
        CycleCase{"k_is_no_word_of_g74", "G74 R.1 Z-1 Q.1 K.1", "CEN0501 2:17"}),
    [](const auto& i) { return i.param.name; });

TEST(CycleLength, AsManyMovesAsAMachineQueuesForABlockArePossible) {
  // 3 moves a peck and 3 besides: 660 pecks of .01 are 1983 moves, 670 are too many.
  ProgramRun fits("G97 G99 S500 M3\nG83 R0 Z-6.6 Q.01\n");
  EXPECT_EQ(fits.step(), StepState::Ended) << fits.alarm();
  EXPECT_EQ(fits.events("line").size(), 660U);
  ProgramRun is_too_long("G97 G99 S500 M3\nG83 R0 Z-6.7 Q.01\n");
  EXPECT_EQ(is_too_long.step(), StepState::Alarmed);
}

using ControlSetup = interpreter::Setup;  // gtest keeps a private member named Setup

struct RefusalCase {
  std::string name;
  std::string text;
  std::string verdict;  ///< id and line:column
};

class Refusal : public testing::TestWithParam<RefusalCase> {};

TEST_P(Refusal, NamesTheErrorAndThePlace) {
  ProgramRun run(GetParam().text);
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with(GetParam().verdict + " ")) << run.alarm();
  EXPECT_EQ(run.step(), StepState::Alarmed) << "an alarm is the end";
}

INSTANTIATE_TEST_SUITE_P(
    , Refusal,
    testing::Values(
        RefusalCase{"empty_program", "", "CEN0606 0:0"},
        RefusalCase{"nul", std::string("X1\n\0\n", 5), "CEN1003 2:1"},
        RefusalCase{"nul_in_comment", std::string("(A\0)\n", 5), "CEN1003 1:3"},
        RefusalCase{"above_127", "X1 \xE4\n", "CEN1003 1:4"},
        RefusalCase{"not_an_address", "X1 $\n", "CEN0518 1:4"},
        RefusalCase{"unknown_word", "FOO\n", "CEN0501 1:1"},
        RefusalCase{"letter_alone", "X\n", "CEN0501 1:1"},
        RefusalCase{"word_nothing_takes", "G1 X1 Q5\n", "CEN0501 1:7"},
        RefusalCase{"repeat_count_without_call", "X1 L3\n", "CEN0501 1:4"},
        RefusalCase{"g_expression", "G[1]\n", "CEN0550 1:1"},
        RefusalCase{"g_with_fraction", "G1.5 X1\n", "CEN0549 1:1"},
        RefusalCase{"m_too_high", "M100\n", "CEN0518 1:1"},
        RefusalCase{"tool_too_high", "T2501\n", "CEN0523 1:1"},
        RefusalCase{"offset_too_high", "T0125\n", "CEN0524 1:1"},
        RefusalCase{"feed_too_high", "G98 F1000\n", "CEN0519 1:5"},
        RefusalCase{"speed_zero", "S0\n", "CEN0520 1:1"},
        RefusalCase{"position_too_far", "X100000\n", "CEN0544 1:1"},
        RefusalCase{"too_many_digits", "X1234567890123456789\n", "CEN0544 1:2"},
        RefusalCase{"x_and_u", "X1 U1\n", "CEN0529 1:4"},
        RefusalCase{"dwell_without_time", "G4\n", "CEN0540 1:3"},
        RefusalCase{"dwell_too_short", "G4 P0\n", "CEN0539 1:4"},
        RefusalCase{"two_settings", "G50 G52 X1\n", "CEN0518 1:5"},
        RefusalCase{"line_with_corner_without_comma", "G1 X1 R.1\n", "CEN0518 1:4"},
        RefusalCase{"negative_polar_radius", "G1 R-1 AB0\n", "CEN0522 1:4"},
        RefusalCase{"negative_radius_with_center", "G2 R-1 ZC1 X0\n", "CEN0521 1:4"},
        RefusalCase{"program_number", "O10000\n", "CEN0301 1:1"},
        RefusalCase{"o_after_words", "X1 O5\n", "CEN0518 1:4"},
        RefusalCase{"two_jumps", "GOTO 1 GOTO 2\n", "CEN0518 1:8"},
        RefusalCase{"jump_and_end", "GOTO 1 M30\nN1\n", "CEN0518 1:0"},
        RefusalCase{"repeat_too_high", "GOSUB 1 L10000\nN1\n", "CEN0538 1:9"},
        RefusalCase{"m98_repeat_too_high", "M98 P1 L1000\n", "CEN0538 1:8"},
        RefusalCase{"call_of_nothing", "CALL 9\n", "CEN0567 1:0"},
        RefusalCase{"then_without_if", "THEN X1\n", "CEN0518 1:1"},
        RefusalCase{"status_parameter", "P208=1\n", "CEN1005 1:1"},
        RefusalCase{"table_parameter_outside_g10", "P500=1\n", "CEN0517 1:1"},
        RefusalCase{"move_in_data_mode", "G10\nX1\n", "CEN0543 2:0"},
        RefusalCase{"byte_too_high", "PB81=256\n", "CEN0517 1:1"},
        RefusalCase{"tangent_of_one_point", "TANL C3\n", "CEN0554 1:1"},
        // CEN-013, CEN-048, CEN-049: corners
        RefusalCase{"comma_alone", "G98 F9\nX1 , Z2\n", "CEN0518 2:4"},
        RefusalCase{"two_roundings", "G98 F9\nX1 ,R1 ,R2\n", "CEN0529 2:8"},
        RefusalCase{"negative_rounding", "G98 F9\nX1 ,R-1\n", "CEN0521 2:4"},
        RefusalCase{"negative_chamfer", "G98 F9\nX1 ,C-1\n", "CEN0535 2:4"},
        RefusalCase{"both_corners", "G98 F9\nX1 ,R1 ,C1\n", "CEN0536 2:8"},
        RefusalCase{"corner_without_move", "G98 F9\nM8 ,R1\n", "CEN0518 2:4"},
        RefusalCase{"straight_lines", "G98 F9\nZ1 ,R.1\nZ2\n", "CEN0530 2:0"},
        RefusalCase{"line_to_tangent_arc", "G98 F9\nZ5 ,R.1\nG3 I2 X8 Z5\n", "CEN0531 2:0"},
        RefusalCase{"arc_to_tangent_line", "G98 F9\nZ5\nG3 I2 X8 Z5 ,R.1\nG1 Z0\n", "CEN0532 3:0"},
        RefusalCase{"arc_to_tangent_arc", "G98 F9\nZ5\nG3 I2 X8 Z5 ,R.1\nG2 I1 X12\n",
                    "CEN0533 3:0"},
        RefusalCase{"chamfer_at_arc", "G98 F9\nZ5 ,C.1\nG3 K-2 X4 Z3\n", "CEN0537 2:0"},
        RefusalCase{"corner_too_large", "G98 F9\nZ5 ,R9\nX40\n", "CEN1030 2:0"},
        // CEN-050, CEN-051
        RefusalCase{"back_without_angle", "G98 F9\nX1 BACK C0\n", "CEN0518 2:4"},
        RefusalCase{"back_of_1", "G98 F9\nX1 BACK C1 W5\n", "CEN0517 2:10"},
        RefusalCase{"back_twice", "G98 F9\nX1 BACK W5 BACK W5\n", "CEN0529 2:12"},
        RefusalCase{"back_of_rapid", "G98 F9\nX1\nG0 X1 BACK W5\n", "CEN0518 3:7"},
        // CEN-179, CEN-180, CEN-181
        RefusalCase{"tangent_without_case", "TANA\n", "CEN0518 1:1"},
        RefusalCase{"tangent_case_4", "TANL C4\n", "CEN0517 1:7"},
        RefusalCase{"tangent_arc_apart", "P93=9 P96=1\nTANA C0\n", "CEN0509 2:1"},
        RefusalCase{"points_on_a_line", "CGEN\n", "CEN0554 1:1"},
        RefusalCase{"forced", "P1=549\nG997\n", "CEN0549 2:0"},
        RefusalCase{"forced_without_text", "P1=321\nG997\n", "CEN1006 2:0"},
        RefusalCase{"fatal", "G999\n", "CEN0200 1:0"}),
    [](const auto& i) { return i.param.name; });

TEST(Refusals, ABlockMayHave4096CharactersAndNoMore) {
  ProgramRun fits(std::string(4094, ' ') + "X1\nX2\n");
  EXPECT_EQ(fits.step(), StepState::Ended);
  EXPECT_EQ(fits.events("line").size(), 2U);
  ProgramRun too_long("X1\n" + std::string(1 << 20, ' ') + "X1\n");
  EXPECT_EQ(too_long.step(), StepState::Alarmed);
  EXPECT_TRUE(too_long.alarm().starts_with("CEN1002 2:0")) << too_long.alarm();
}

TEST(Refusals, BlocksBeforeTheFaultyOneAreExecutedAndNoOthers) {
  ProgramRun run("X1\nX2 Z[1/0]\nX3\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_EQ(run.events("line").size(), 1U);
  EXPECT_EQ(run.interpreter().blocks(), 1U);
}

TEST(Refusals, DeepNestingOfBracketsIsRefused) {
  ProgramRun run("P1=" + std::string(2000, '[') + "1\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.alarm().starts_with("CEN0518")) << run.alarm();
}

TEST(Setups, ForeignRecordsAreRefusedByName) {
  const auto refusal = [](const ControlSetup& setup) {
    MemorySource source("");
    EventLog log;
    const auto made = kCenturionDialect.make(setup, source, log);
    return made ? std::string("accepted") : made.error().what;
  };
  ControlSetup offset;
  offset.offsets.push_back({"G60", {}});
  EXPECT_NE(refusal(offset).find("G60"), std::string::npos);
  ControlSetup variable;
  variable.variables.push_back({"Q5", 1});
  EXPECT_NE(refusal(variable).find("Q5"), std::string::npos);
  ControlSetup tool;
  tool.tools.resize(1);
  tool.tools[0].number = 25;
  EXPECT_NE(refusal(tool).find("25"), std::string::npos);
  ControlSetup start;
  start.start.set(Axis::Y, Length::mm(1));
  EXPECT_NE(refusal(start).find('Y'), std::string::npos);
  ControlSetup option;
  option.control.set("circular", {true, 3});
  EXPECT_NE(refusal(option).find("circular"), std::string::npos);
}

}  // namespace

}  // namespace dripline::interpreter::centurion
