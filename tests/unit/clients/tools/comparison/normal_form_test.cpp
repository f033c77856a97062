#include "clients/tools/comparison/normal_form.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace dripline::comparison {
namespace {

std::string normal(std::string_view control, std::string_view line, NormalForm form = {}) {
  std::string out;
  append_normal(line, lexical_rules(control), form, out);
  return out;
}

struct Case {
  std::string_view name, control, line, expected;
};

class NormalFormOfALine : public testing::TestWithParam<Case> {};
TEST_P(NormalFormOfALine, Is) {
  EXPECT_EQ(normal(GetParam().control, GetParam().line), GetParam().expected);
}
INSTANTIATE_TEST_SUITE_P(
    , NormalFormOfALine,
    testing::Values(
        Case{"numbers", "rs274ngc", "N10 g01 x1.0 Y+02.500 z.5 (cut)", "G1X1Y2.5Z0.5"},
        Case{"a_point_that_scales", "fanuc", "G01 X1 Y1.0 Z01.", "G1X1Y1.Z1."},
        Case{"a_point_that_scales_on_a_lathe", "centurion", "X01.500 Z-00.0", "X1.5Z-0"},
        Case{"a_zero_has_no_scale", "fanuc", "G01 X0 Y0. Z00.00", "G1X0Y0Z0"},
        Case{"a_comment_alone", "fanuc", "(T1 = 10 MM)", ""},
        Case{"blanks_alone", "tnc155", "  \t\r", ""},
        Case{"a_comment_to_the_end", "rs274ngc", "G0 X1 ; to the start", "G0X1"},
        Case{"a_comment_that_prints", "rs274ngc", "(PRINT, at #100)", "(PRINT, at #100)"},
        Case{"a_comment_with_a_message", "rs274ngc", "( msg, Turn it)", "( msg, Turn it)"},
        Case{"a_report_line", "fanuc", " DPRNT[X#1[42] A 1.0] ", "DPRNT[X#1[42] A 1.0]"},
        Case{"two_numbers_stay_two", "rs274ngc", "X1 2 Y3 . 5", "X1 2Y3 . 5"},
        Case{"a_block_number_without_n", "tnc155", "12 L X+10,50 R0 F100", "LX10.5R0F100"},
        Case{"an_assignment_is_no_block_number", "fanuc", "#1=[#2+1.50]", "#1=[#2+1.5]"},
        Case{"two_points_are_no_number", "rs274ngc", "X1..50", "X1..50"},
        Case{"a_control_that_is_not_known", "other", " g1 X1.0 ", "g1 X1.0"},
        Case{"counts_stay", "tektronix-1704", "G01X0100", "G01X0100"},
        Case{"an_open_comment_stays", "rs274ngc", "G1 X1 (oh", "G1 X1 (oh"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(NormalForm, KeepsBlockNumbersWhereTheyAreWanted) {
  EXPECT_EQ(normal("fanuc", "N0010 X1", {.keeps_block_numbers = true}), "N10X1");
}

TEST(NormalForm, OfItselfIsItself) {
  for (const char* line : {"N10 G1 X1.50 (A)", "#1=[#2+1.0]", "G0 X-0.10 Y+1"}) {
    const std::string once = normal("rs274ngc", line);
    EXPECT_EQ(normal("rs274ngc", once, {.keeps_block_numbers = true}), once);
  }
}

struct Change {
  std::string_view name, before, after;
  TextChange expected;
};
class ChangeOfABlock : public testing::TestWithParam<Change> {};
TEST_P(ChangeOfABlock, Is) {
  EXPECT_EQ(change_of(GetParam().before, GetParam().after), GetParam().expected);
  EXPECT_EQ(change_of(GetParam().after, GetParam().before), GetParam().expected);
}
INSTANTIATE_TEST_SUITE_P(
    , ChangeOfABlock,
    testing::Values(Change{"nothing", "G1X1", "G1X1", TextChange::None},
                    Change{"a_feed", "G1X1F100", "G1X1F120", TextChange::FeedAndSpeed},
                    Change{"a_speed_put_in", "M3", "S100M3", TextChange::FeedAndSpeed},
                    Change{"a_block_of_a_feed", "", "F100", TextChange::FeedAndSpeed},
                    Change{"an_offset_number", "G43H1Z5", "G43H2Z5", TextChange::Offsets},
                    Change{"a_work_offset", "G54X0", "G55X0", TextChange::Offsets},
                    Change{"offsets_set", "G10L2P1X0", "G10L2P1X5", TextChange::Offsets},
                    Change{"a_coordinate", "G1X1", "G1X2", TextChange::Other},
                    Change{"a_computed_feed", "F#1", "F#2", TextChange::Other},
                    Change{"a_coordinate_and_a_feed", "X1F1", "X2F2", TextChange::Other}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace dripline::comparison
