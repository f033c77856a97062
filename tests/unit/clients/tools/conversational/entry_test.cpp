#include "clients/tools/conversational/entry.hpp"

#include <gtest/gtest.h>

namespace dripline::conversational {
namespace {

TEST(ConversationalEntry, ReadsNumbersAndFractions) {  // CEN-244
  EXPECT_EQ(parse_entry("1.75")->value, 1.75);
  EXPECT_EQ(parse_entry("-.5")->value, -0.5);
  EXPECT_EQ(parse_entry(" +3. ")->value, 3);
  EXPECT_EQ(parse_entry("7/8")->value, 0.875);
  EXPECT_EQ(parse_entry("-3/64")->value, -0.046875);
  EXPECT_TRUE(parse_entry("7/8")->is_fraction);
  EXPECT_FALSE(parse_entry(".875")->is_fraction);
}

TEST(ConversationalEntry, RefusesEverythingElseByName) {
  for (const std::string wrong : {"", ".", "-", "1e3", "1,5", "0x4", "inf", "1/2/3", "/4", "4/",
                                  "1.5/2", "--1", "1 2", "123456789012345678901", "1234567890/3"}) {
    const auto read = parse_entry(wrong);
    ASSERT_FALSE(read) << wrong;
    EXPECT_NE(read.error().what.find('"' + wrong), std::string::npos) << read.error().what;
  }
  EXPECT_EQ(parse_entry("3/0").error().what, "\"3/0\" divides by zero");
}

TEST(ConversationalEntry, WritesNumbersAsTheControlDoes) {
  EXPECT_EQ(number_text(0.25), ".25");
  EXPECT_EQ(number_text(-0.0625), "-.0625");
  EXPECT_EQ(number_text(12), "12");
  EXPECT_EQ(number_text(100), "100");
  EXPECT_EQ(number_text(-3.10), "-3.1");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0000001), "0");
  EXPECT_EQ(number_text(1.0 / 13), ".076923");
}

}  // namespace
}  // namespace dripline::conversational
