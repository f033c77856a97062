#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "tests/unit/gateway/interpreter/dialects/fanuc/program_run.hpp"

/// What a setup may say, and what is refused with its reason.
namespace dripline::interpreter::fanuc {
namespace {

std::string refusal_of(const std::string& toml) {
  const auto setup = parse_setup(toml);
  if (!setup) return "the setup itself: " + setup.error().what;
  MemorySource source("M30\n");
  EventLog log;
  const auto made = kFanucDialect.make(*setup, source, log);
  return made ? "" : made.error().what;
}

struct RefusalCase {
  const char* name;
  const char* toml;
  const char* words;
};

class FanucSetup : public testing::TestWithParam<RefusalCase> {};

TEST_P(FanucSetup, IsRefusedWithTheReason) {
  EXPECT_NE(refusal_of(GetParam().toml).find(GetParam().words), std::string::npos)
      << refusal_of(GetParam().toml);
}

INSTANTIATE_TEST_SUITE_P(
    , FanucSetup,
    testing::Values(
        RefusalCase{"unknown_option", "[control]\ncolor = 1", "color"},
        RefusalCase{"unknown_model", "[control]\nmodel = \"31i\"", "16M"},
        RefusalCase{"start_in_a_cycle", "[control]\nstart_g = [81]", "G81"},
        RefusalCase{"start_with_no_code", "[control]\nstart_g = [999]", "G999"},
        RefusalCase{"skip_level", "[control]\nskip_levels = [10]", "10"},
        RefusalCase{"half_a_limit", "[control]\nstroke_limits = [ { X = 1.0 } ]", "stroke_limits"},
        RefusalCase{"five_references",
                    "[control]\nreference = [ {X=0.0}, {X=0.0}, {X=0.0}, {X=0.0}, {X=0.0} ]", "5"},
        RefusalCase{"g65_as_a_code_call", "[control]\ng_macro = [65]", "G65"},
        RefusalCase{"depth", "[control]\nmax_call_depth = 99", "99"},
        RefusalCase{"offset_name", "[[offset]]\nname = \"G60\"\nX = 1.0", "G60"},
        RefusalCase{"tool_number", "[[tool]]\nnumber = 401\nradius = 1.0", "401"},
        RefusalCase{"variable", "[[variable]]\nname = \"#150\"\nvalue = 1.0", "#150"},
        RefusalCase{"variable_of_others", "[[variable]]\nname = \"Q1\"\nvalue = 1.0", "Q1"},
        RefusalCase{"kinematics_word", "[control]\nkinematics = \"gantry\"", "head-table"},
        RefusalCase{"axis_without_kinematics", "[control]\nrotary_master = \"A+\"",
                    "rotary_master"},
        RefusalCase{"no_master", "[control]\nkinematics = \"table-table\"", "rotary_master"},
        RefusalCase{"no_slave", "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"",
                    "rotary_slave"},
        RefusalCase{"axis_without_a_direction",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A\"", "A+"},
        RefusalCase{"parallel_axes",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"A-\"",
                    "the master's axis"},
        RefusalCase{"table_on_c",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"C+\"\n"
                    "rotary_slave = \"A+\"",
                    "C does not tilt"},
        RefusalCase{"head_under_c",
                    "[control]\nkinematics = \"head-head\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"",
                    "C does not tilt"},
        RefusalCase{"head_of_c",
                    "[control]\nkinematics = \"head-table\"\nrotary_master = \"C+\"\n"
                    "rotary_slave = \"A+\"",
                    "C does not tilt"},
        RefusalCase{"no_center",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"\ntable_centers = [ { Y = 0.0, Z = 0.0 } ]",
                    "no point for C"},
        RefusalCase{"half_a_center",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"\n"
                    "table_centers = [ { Y = 0.0, Z = 0.0 }, { X = 1.0 } ]",
                    "has no Y"},
        RefusalCase{"center_of_a_head_that_is_none",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"\nhead_centers = [ { X = 0.0 } ]\n"
                    "table_centers = [ { Y = 0.0, Z = 0.0 }, { X = 1.0, Y = 1.0 } ]",
                    "head_centers"},
        RefusalCase{"far_center",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"\n"
                    "table_centers = [ { Y = 1e300, Z = 0.0 }, { X = 1.0, Y = 1.0 } ]",
                    "beyond"},
        RefusalCase{"rotary_range",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"\n"
                    "table_centers = [ { Y = 0.0, Z = 0.0 }, { X = 1.0, Y = 1.0 } ]\n"
                    "rotary_limits = [ { A = 10.0 }, { A = -10.0 } ]",
                    "no range"},
        RefusalCase{"coarse_tolerance",
                    "[control]\nkinematics = \"table-table\"\nrotary_master = \"A+\"\n"
                    "rotary_slave = \"C+\"\n"
                    "table_centers = [ { Y = 0.0, Z = 0.0 }, { X = 1.0, Y = 1.0 } ]\n"
                    "tip_tolerance = 5.0",
                    "tip_tolerance"},
        RefusalCase{"mirror_switch", "[switches]\nmirror = [\"X\"]", "mirror"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(FanucSetupOptions, EveryOptionIsReadInItsKind) {
  EXPECT_EQ(refusal_of("units = \"in\"\n[control]\nmodel = \"11M\"\ncalculator_point = true\n"
                       "increment = \"IS-A\"\nstart_units = \"mm\"\nrepeat_address = \"K\"\n"
                       "m98_form = \"both\"\noffset_memory = \"B\"\nstartup = \"B\"\n"
                       "g73_return = 0.01\ng83_clearance = 0.02\nshift_direction = \"-X\"\n"
                       "single_direction = { X = 0.1 }\narc_error = 0.0\n"
                       "arc_without_center = \"alarm\"\nscale_default = 2.0\n"
                       "rotate_default = 10.0\nrotate_incremental = true\n"
                       "leading_zero_print = false\nprint_newline = \"LFCRCR\"\natan_range = 1\n"
                       "reset_clears_locals = false\nreset_clears_commons = false\n"
                       "semicolon_eob = false\ncomment_over_eob = true\nfeed_unit_inch = 1.0\n"
                       "short_radius = \"semicircle\"\ndiameter_offset = true\nbefore_m = [10]\n"
                       "print_overflow = \"expand\"\ndnc = true\nunroll = true\n"
                       "max_call_depth = 2\nmax_nesting = 4\nmax_loops = 10\nmax_blocks = 100\n"
                       "last_common = 199\nlast_kept = 999\nlength_axis = \"C\"\nt_macro = true\n"
                       "g_macro = [100]\nm_macro = [60]\nskip_levels = [3]\n"),
            "");
}

TEST(FanucSnapshot, OfAnotherDialectOrDamagedChangesNothing) {
  ProgramRun run("G91 G00 X1.\nG66 P9 A1.\nX2.\nM30\n");
  ASSERT_EQ(run.step(1), StepState::Ran);
  const Snapshot whole = run.interpreter().snapshot();
  Snapshot foreign = whole;
  foreign.dialect = "centurion";
  EXPECT_EQ(run.interpreter().restore(foreign).error().code, Errc::Unsupported);
  Snapshot cut = whole;
  cut.bytes.resize(cut.bytes.size() / 2);
  EXPECT_EQ(run.interpreter().restore(cut).error().code, Errc::Corrupt);
  Snapshot longer = whole;
  longer.bytes.push_back(std::byte{0});
  EXPECT_EQ(run.interpreter().restore(longer).error().code, Errc::Corrupt);
  EXPECT_EQ(run.interpreter().snapshot().digest(), whole.digest());
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
