#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// Bad words of the drilling and grooving cycles are reported before anything moves (CEN-120,
/// CEN-129, CEN-130, CEN-133).
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
        CycleCase{"probe_in_a_cycle", "PROBE1 G81 R.1 Z-1", "CEN0518 2:0"},
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

}  // namespace
}  // namespace dripline::interpreter::centurion
