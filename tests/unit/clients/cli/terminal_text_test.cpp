#include "clients/cli/text/terminal_text.hpp"

#include <gtest/gtest.h>

#include "clients/cli/text/error_output.hpp"

namespace dripline::cli {
namespace {

struct SteeringCase {
  const char* name;
  const char* text;
  const char* printable;
  const char* visible;
};
class Steering : public testing::TestWithParam<SteeringCase> {};

TEST_P(Steering, IsABlankInALineAndVisibleInAText) {
  EXPECT_EQ(printable(GetParam().text), GetParam().printable);
  EXPECT_EQ(visible(GetParam().text), GetParam().visible);
}
INSTANTIATE_TEST_SUITE_P(
    , Steering,
    testing::Values(SteeringCase{"escape", "a\x1b[2Jb", "a [2Jb", "a\\x1b[2Jb"},
                    SteeringCase{"bell", "\a", " ", "\\x07"},
                    SteeringCase{"carriage_return", "a\rb", "a b", "a\\x0db"},
                    SteeringCase{"last_carriage_return", "a\r", "a ", "a\\x0d"},
                    SteeringCase{"line_end", "a\r\nb\n", "a  b ", "a\r\nb\n"},
                    SteeringCase{"tab", "a\tb", "a b", "a\tb"},
                    SteeringCase{"del", "\x7f", " ", "\\u007f"},
                    SteeringCase{"c1", "\u009b31m", " 31m", "\\u009b31m"},
                    SteeringCase{"first_c1", "\u0080", " ", "\\u0080"},
                    SteeringCase{"no_break_space", "\u00a0", "\u00a0", "\u00a0"},
                    SteeringCase{"override", "\u202eb", " b", "\\u202eb"},
                    SteeringCase{"isolate", "\u2066\u2069", "  ", "\\u2066\\u2069"},
                    SteeringCase{"marks", "\u200e\u200f\u061c", "   ", "\\u200e\\u200f\\u061c"},
                    SteeringCase{"dash", "\u2014", "\u2014", "\u2014"},
                    SteeringCase{"emoji", "\U0001f980", "\U0001f980", "\U0001f980"},
                    SteeringCase{"byte_of_c1", "a\x9b", "a ", "a\\x9b"},
                    SteeringCase{"latin_1", "M\xfcller", "M\xfcller", "M\xfcller"},
                    SteeringCase{"overlong_escape", "\xc0\x9b[2J", "\xc0 [2J", "\xc0\\x9b[2J"},
                    SteeringCase{"cut_off", "\xe2\x80", "\xe2 ", "\xe2\\x80"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(Styled, IsAnEscapeSequenceOnlyForATerminal) {
  EXPECT_EQ(styled("good", Style::Good, false), "good");
  EXPECT_EQ(visible(styled("good", Style::Good, true)), "\x1b[32mgood\x1b[0m");
}

TEST(Styled, LetsNothingElseThrough) {
  EXPECT_EQ(visible(styled("\x1b[31m", Style::Good, true) + "\x1b[32m"),
            "\x1b[32m\\x1b[31m\x1b[0m\\x1b[32m");
}

TEST(VisibleText, ShowsWhatCouldSteerATerminal) {
  VisibleText visible;
  EXPECT_EQ(visible.take("X1\x1b[2J\r\tY\x7f\n"), "X1\\x1b[2J\\x0d\tY\\u007f\n");
}

TEST(VisibleText, KeepsUtf8AndFindsControlsOfTwoBytesAcrossPieces) {
  VisibleText visible;
  std::string text(visible.take("20 \xc2\xb0 \xc3\xa9 \xc2"));
  text += visible.take(
      "\x9b"
      "31m \xc2");
  text += visible.take("\xb5");
  EXPECT_EQ(text,
            "20 \xc2\xb0 \xc3\xa9 \\u009b"
            "31m \xc2\xb5");
}

TEST(VisibleText, KeepsLineEndsOfTwoAcrossPieces) {
  VisibleText visible;
  std::string text(visible.take("a\r"));
  text += visible.take("\nb\r");
  text += visible.take("c");
  EXPECT_EQ(text, "a\r\nb\\x0dc");
}

TEST(PrintError, MakesALineOfEachText) {
  testing::internal::CaptureStderr();
  print_error("dnc: {}, {}\n", std::string("a\nb\u009b"), 3);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "dnc: a b , 3\n");
}

}  // namespace
}  // namespace dripline::cli
