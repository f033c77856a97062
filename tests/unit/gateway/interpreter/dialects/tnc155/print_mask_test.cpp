#include "gateway/interpreter/dialects/tnc155/itnc/print_mask.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// Masks of FN 16.
namespace dripline::interpreter::tnc155::itnc {
namespace {

using testing::ElementsAre;

const LocalTime kNow{2026, 3, 7, 9, 5, 59, 0};
const std::vector<double> kValues{1.5, -2.25, 1234.56789, 7};

std::vector<std::string> lines_of(std::string_view mask) {
  const auto printed = print_mask(mask, kValues, kNow);
  return printed ? printed->lines : std::vector<std::string>{"! " + printed.error().what};
}

TEST(PrintMask, PutsValuesIntoTheirPlaces) {
  EXPECT_THAT(lines_of("\"A=%6.2LF|\",Q1;\n\"%.0F %F\",Q3,Q0;"),
              ElementsAre("A= -2.25|", "7 1.500000"));
  EXPECT_THAT(lines_of("\"%4d|%I\",Q2,Q3;"), ElementsAre("1235|7"));
  EXPECT_THAT(lines_of("\"100 %% done\";"), ElementsAre("100 % done"));
}

TEST(PrintMask, PutsOutTheTime) {
  EXPECT_THAT(lines_of("\"%2d.%2d.%4d\",DAY,MONTH,YEAR4;\"%2d:%2d:%2d %2d\",HOUR,MIN,SEC,YEAR2;"),
              ElementsAre(" 7. 3.2026", " 9: 5:59 26"));
  const auto unknown = print_mask("\"%2d\",DAY;", kValues, std::nullopt);
  ASSERT_TRUE(unknown);
  EXPECT_TRUE(unknown->needs_time);
  const auto without = print_mask("\"%2d\",Q3;", kValues, std::nullopt);
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->needs_time);
}

TEST(PrintMask, PassesOverCommentsAndTheEnd) {
  EXPECT_THAT(lines_of("* \"no\n\n\"yes\";\r\nM_CLOSE;\n"), ElementsAre("yes"));
  EXPECT_THAT(lines_of(""), ElementsAre());
}

TEST(PrintMask, RefusesWhatItDoesNotKnowWithTheLine) {
  EXPECT_THAT(lines_of("\"a\";\nL_GERMAN;"),
              ElementsAre("! line 2 of the mask: L_GERMAN is not known here"));
  EXPECT_THAT(lines_of("\"%S\",QS1;"),
              ElementsAre("! line 1 of the mask: %S is no format known here"));
  EXPECT_THAT(lines_of("\"%5.3F\",Q4;"),
              ElementsAre("! line 1 of the mask: Q4 is no value known here"));
  EXPECT_THAT(lines_of("\"%5.3F\",Q108;"),
              ElementsAre("! line 1 of the mask: Q108 is no value known here"));
  EXPECT_THAT(lines_of("\"%5.3F\";"),
              ElementsAre("! line 1 of the mask: the text has more places than values"));
  EXPECT_THAT(
      lines_of("\"a\",Q1;"),
      ElementsAre("! line 1 of the mask: more values than the text has places for, or no ;"));
  EXPECT_THAT(lines_of("\n\"a"), ElementsAre("! line 2 of the mask: the text has no closing \""));
  EXPECT_THAT(lines_of("\"%999F\",Q1;"),
              ElementsAre("! line 1 of the mask: %999F is no format known here"));
}

}  // namespace
}  // namespace dripline::interpreter::tnc155::itnc
