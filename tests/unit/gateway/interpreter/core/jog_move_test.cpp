#include "gateway/interpreter/core/jog_move.hpp"

#include <gtest/gtest.h>

namespace dripline::interpreter {
namespace {

TEST(JogMove, IsWrittenAsItIsRead) {
  for (const char* text : {"X -1.5 mm", "Z 0.0001 in F2.5", "C 90 deg F300", "W 1e-05 mm",
                           "X 50 mm hold=a", "X -50 mm F300 hold=3f-Aa"}) {
    const auto move = parse_jog_move(text);
    ASSERT_TRUE(move) << text;
    EXPECT_EQ(to_text(*move), text);
    EXPECT_EQ(parse_jog_move(to_text(*move)).value(), *move);
  }
}

TEST(JogMove, IsKeptByItsWord) {
  EXPECT_EQ(parse_jog_keep(keep_text("3f-Aa")), "3f-Aa");
  for (const char* text : {"", "keep", "keep=", "keep=a b", "hold=a", "X 1 mm hold=a", "Keep=a"})
    EXPECT_FALSE(parse_jog_keep(text)) << text;
  EXPECT_FALSE(is_hold_word(std::string(65, 'a')));
}

TEST(JogMove, HasItsSizeInMillimetersAndDegrees) {
  const auto linear = parse_jog_move("Y -2 in F10").value();
  EXPECT_DOUBLE_EQ(linear.canonical(), -50.8);
  EXPECT_DOUBLE_EQ(linear.canonical_feed().value(), 254);
  const auto rotary = parse_jog_move("A 2 deg").value();
  EXPECT_EQ(rotary.canonical(), 2);
  EXPECT_FALSE(rotary.canonical_feed());
}

TEST(JogMove, IsNothingElse) {
  for (const char* text : {"",
                           " ",
                           "X",
                           "X 1",
                           "X 1 m",
                           "X 1 deg",
                           "A 1 mm",
                           "X nan mm",
                           "X inf mm",
                           "X 0 mm",
                           "X -0 mm",
                           "X 1e999 mm",
                           "X 1mm",
                           "Q 1 mm",
                           "XX 1 mm",
                           "X 1 mm F",
                           "X 1 mm F0",
                           "X 1 mm F-1",
                           "X 1 mm Finf",
                           "X 1 mm F1 2",
                           "X 1 mm G1",
                           "X +1 mm",
                           "X 0x1 mm",
                           "X 1 mm hold",
                           "X 1 mm hold=",
                           "X 1 mm hold=a b",
                           "X 1 mm hold=a F3",
                           "X 1 mm F3 hold=a=",
                           "keep=a"})
    EXPECT_FALSE(parse_jog_move(text)) << text;
}

}  // namespace
}  // namespace dripline::interpreter
