#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/core.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

/// X of a move to Q9 after these blocks.
std::string q9_after(std::vector<std::string> blocks) {
  blocks.insert(blocks.end(), {"L X+1 R0 F MAX", "L X+Q9 F MAX"});
  return moves_of(blocks).back();
}

// HD-154: what was never set is 0; HD-160
TEST(TncParameters, BeginAtZero) {
  EXPECT_EQ(q9_after({}), "R X0");
  EXPECT_EQ(q9_after({"FN 0: Q2 = +7", "FN 0: Q9 = -Q2"}), "R X-7");
}

// HD-155, HD-156, HD-157, HD-158: 7 DIV -2, LEN of 3 and 4.
TEST(TncParameters, FunctionsCalculate) {
  EXPECT_EQ(q9_after({"FN 0: Q1 = +7", "FN 1: Q9 = +Q1 + +2,5"}), "R X9.5");
  EXPECT_EQ(q9_after({"FN 0: Q1 = +7", "FN 2: Q9 = +1,000 - +Q1"}), "R X-6");
  EXPECT_EQ(q9_after({"FN 0: Q1 = +7", "FN 3: Q9 = +Q1 * -3"}), "R X-21");
  EXPECT_EQ(q9_after({"FN 0: Q1 = +7", "FN 4: Q9 = +Q1 DIV -2"}), "R X-3.5");
  EXPECT_EQ(q9_after({"FN 5: Q9 = SQRT +6,25"}), "R X2.5");
  EXPECT_EQ(q9_after({"FN 6: Q9 = SIN +30"}), "R X0.5");
  EXPECT_EQ(q9_after({"FN 7: Q9 = COS +180"}), "R X-1");
  EXPECT_EQ(q9_after({"FN 7: Q9 = COS +90"}), "R X0");
  EXPECT_EQ(q9_after({"FN 8: Q9 = +3 LEN +4"}), "R X5");
}

// HD-163
TEST(TncParameters, WhatHasNoResultIsAnError) {
  EXPECT_EQ(q9_after({"FN 4: Q9 = +1 DIV +0"}), "! ARITHMETICAL ERROR");
  EXPECT_EQ(q9_after({"FN 5: Q9 = SQRT -1"}), "! ARITHMETICAL ERROR");
  EXPECT_EQ(q9_after({"FN 0: Q1 = +30000", "FN 3: Q9 = +Q1 * +4"}), "! ARITHMETICAL ERROR");
}

// HD-159: equal, not equal, greater, less; jumped over is the move to X1.
TEST(TncParameters, JumpsCompare) {
  const auto jumps = [](const std::string& condition) {
    const auto moves =
        moves_of({"FN 0: Q1 = +5", condition, "L X+1 R0 F MAX", "LBL 3", "L X+2 F MAX"});
    return moves.size() == 1;
  };
  EXPECT_TRUE(jumps("FN 9: IF +Q1 EQU +5 GOTO LBL 3"));
  EXPECT_FALSE(jumps("FN 9: IF +Q1 EQU +5,001 GOTO LBL 3"));
  EXPECT_TRUE(jumps("FN 10: IF +Q1 NE +4 GOTO LBL 3"));
  EXPECT_FALSE(jumps("FN 10: IF +Q1 NE +5 GOTO LBL 3"));
  EXPECT_TRUE(jumps("FN 11: IF +Q1 GT +4 GOTO LBL 3"));
  EXPECT_FALSE(jumps("FN 11: IF +Q1 GT +5 GOTO LBL 3"));
  EXPECT_TRUE(jumps("FN 12: IF +Q1 LT +6 GOTO LBL 3"));
  EXPECT_FALSE(jumps("FN 12: IF +Q1 LT +5 GOTO LBL 3"));
}

// HD-162: a quarter of an ellipse of 40 by 20 in steps of 30 degrees.
TEST(TncParameters, AnEllipseByALoop) {
  EXPECT_THAT(
      moves_of({"FN 0: Q1 = +0", "LBL 1", "FN 7: Q2 = COS +Q1", "FN 3: Q2 = +Q2 * +40",
                "FN 6: Q3 = SIN +Q1", "FN 3: Q3 = +Q3 * +20", "L X+Q2 Y+Q3 R0 F500",
                "FN 1: Q1 = +Q1 + +30", "FN 12: IF +Q1 LT +90,1 GOTO LBL 1"}),
      ElementsAre("L X40 Y0 F500", "L X34.641 Y10 F500", "L X20 Y17.321 F500", "L X0 Y20 F500"));
}

// HD-026, HD-161: what a parameter holds is held to the limits of what it represents.
TEST(TncParameters, HoldWhatCouldBeProgrammed) {
  const auto with = [](const char* value, const char* block, const char* units = "MM") {
    return run_blocks({fmt::format("FN 0: Q1 = {}", value), "CC X+0 Y+0", block},
                      {"[control]\nfourth_axis = \"A\"", {}, units});
  };
  struct Limit {
    const char* block;
    const char* most;
    const char* more;
    const char* units;
  };
  for (const Limit& limit : {
           Limit{"L X+Q1 R0 F MAX", "+30000", "+30000,001", "MM"},
           Limit{"L IX-Q1 R0 F MAX", "+30000", "+30000,001", "MM"},
           Limit{"L X+Q1 R0 F MAX", "+1181,1", "+1181,2", "INCH"},
           Limit{"L A+Q1 R0 F MAX", "+30000", "+30000,001", "INCH"},
           Limit{"LP PR+Q1 PA+0 R0 F MAX", "+30000", "+30000,001", "MM"},
           Limit{"LP PR+5 PA+Q1 R0 F MAX", "-360", "-360,001", "MM"},
           Limit{"LP PR+5 PA-Q1 R0 F MAX", "-360", "-360,001", "MM"},
           Limit{"TOOL DEF 1 LQ1 R+0", "+30000", "+30000,001", "MM"},
           Limit{"TOOL DEF 1 L+0 RQ1", "+30000", "+30000,001", "MM"},
           Limit{"CYCL DEF 9.1 DWELL Q1", "+1", "+20000", "MM"},
       }) {
    const bool is_dwell = std::string_view(limit.block).starts_with("CYCL");
    const auto within = with(limit.most, limit.block, limit.units);
    const auto beyond = with(limit.more, limit.block, limit.units);
    EXPECT_EQ(within.alarm_id, is_dwell ? "TNC-CYCLE-INCOMPLETE" : "") << limit.block;
    EXPECT_EQ(beyond.alarm_id, "TNC-ENTRY-RANGE") << limit.block;
    EXPECT_EQ(beyond.alarm_line, 4u) << limit.block;
  }
  EXPECT_THAT(with("+50000", "L X-Q1 R0 F MAX").events,
              ElementsAre("! ENTRY VALUE INCORRECT: X -Q1 = -50000 is not within -30000 to 30000"));
}

// HD-096, HD-161: of IPA and of a radius.
TEST(TncParameters, HoldAnglesAndRadiiThatCouldBeProgrammed) {
  const std::vector<std::string> start{"L X+10 Y+0 R0 F100", "CC X+0 Y+0"};
  const auto with = [&](const char* value, std::vector<std::string> rest) {
    std::vector<std::string> blocks = start;
    blocks.push_back(fmt::format("FN 0: Q1 = {}", value));
    blocks.insert(blocks.end(), rest.begin(), rest.end());
    return run_blocks(blocks).alarm_id;
  };
  EXPECT_EQ(with("+5400", {"CP IPA+Q1 DR+"}), "");
  EXPECT_EQ(with("+5400,001", {"CP IPA+Q1 DR+"}), "TNC-ENTRY-RANGE");
  EXPECT_EQ(with("+500", {"CP PA+Q1 DR+"}), "TNC-ENTRY-RANGE");
  EXPECT_EQ(with("+1", {"L X+20 Y+0", "RND RQ1", "L X+20 Y+20"}), "");
  EXPECT_EQ(with("-1", {"L X+20 Y+0", "RND RQ1", "L X+20 Y+20"}), "TNC-ENTRY-RANGE");
  EXPECT_EQ(with("+50000", {"FN 1: Q2 = +Q1 + +Q1", "L X+1"}), "TNC-ARITHMETIC")
      << "of a calculation only its own limit";
  EXPECT_EQ(with("+40000", {"FN 1: Q2 = +Q1 + +Q1", "L X+1"}), "");
}

}  // namespace
}  // namespace dripline::interpreter
