// The block at which a run over a line begins that is to begin at a tool.
#include "gateway/line/heads/tool_finder.hpp"

#include <gtest/gtest.h>

#include "gateway/line/heads/head_scan.hpp"

namespace dripline::line {
namespace {

struct ToolCase {
  const char* name;
  const char* control;
  const char* text;
  std::uint64_t tool;
  std::uint64_t line;  ///< 0: none
};
class ToolPlace : public testing::TestWithParam<ToolCase> {};

TEST_P(ToolPlace, IsTheFirstChangeToIt) {
  const ToolCase& program = GetParam();
  const std::string_view text = program.text;
  for (const std::size_t step : {1U, 5U, 1000U}) {
    PlaceFinder finder({.tool = program.tool}, program.control);
    bool is_found = false;
    for (std::size_t at = 0; at < text.size() && !is_found; at += step)
      is_found = finder.look(text.substr(at, step));
    is_found = is_found || finder.look_at_end();
    EXPECT_EQ(is_found ? finder.place().line : 0, program.line);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ToolPlace,
    testing::Values(
        ToolCase{"with_its_number", "fanuc", "O1\nT2 M6\nX1\nN9 M06 T03\nX2\nT3 M6", 3, 4},
        ToolCase{"not_where_it_is_prepared", "fanuc", "T2 M6\nT3\nG1 X1\nM6\nT2\n", 3, 4},
        ToolCase{"none_that_is_prepared_alone", "fanuc", "T2 M6\nT3\nG1 X1\nT4 M6\nM30\n", 3, 0},
        ToolCase{"none_in_a_comment", "fanuc", "(T3 M6)\nT2 M6\nM30", 3, 0},
        ToolCase{"none_that_the_panel_decides_on", "fanuc", "/T3 M6\nN5 /T3\nM6\nM30\n", 3, 0},
        ToolCase{"none_after_the_program", "fanuc", "T2 M6\nM30\nO2\nT3 M6\nM99\n", 3, 0},
        ToolCase{"none_that_is_computed", "fanuc", "T#3 M6\nT3. M6\nM30\n", 3, 0},
        ToolCase{"of_a_turret", "fanuc-t", "T0202\nX1\nT0303\nX2\nT0300\n", 3, 3},
        ToolCase{"of_a_centurion", "centurion", "T0202 M6\nT0303\nX1.\nM06\n", 3, 4},
        ToolCase{"of_a_tektronix", "tektronix-1704", "N1 T02 M06\nN2 T03\nN3 M06\n", 3, 3},
        ToolCase{"of_a_tnc", "tnc155",
                 "0 BEGIN PGM 7 MM\n1 TOOL DEF 3 L+0 R+5\n2 TOOL CALL 3 Z S1000\n", 3, 3},
        ToolCase{"none_of_another_tnc_tool", "tnc155", "2 TOOL CALL 31 Z S1000\n", 3, 0},
        ToolCase{"of_an_event", "prototrak-plus", "PN7\nN1 G100 X1 Y1 T2\nN2 G100 X2 Y2 T3\n", 3,
                 3}),
    [](const auto& i) { return std::string{i.param.name}; });

/// The tool that was prepared before is prepared again.
TEST(ToolHead, HasTheToolThatIsNext) {
  const std::string text = "G21 G90\nT2 M6\nT3\nG1 X1. F100\nM6\nS900 M3\nG1 X2. F80\nM30\n";
  PlaceFinder finder({.tool = 3}, "fanuc");
  ASSERT_TRUE(finder.look(text));
  HeadScan scan("fanuc", finder.place());
  scan.take(text);
  scan.end();
  const auto head = scan.head(HeadChoice::Send);
  ASSERT_TRUE(head) << head.error().what;
  EXPECT_EQ(*head, "G21 G90\nT3\nG1\n");
}

}  // namespace
}  // namespace dripline::line
