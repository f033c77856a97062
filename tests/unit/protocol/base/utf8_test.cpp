#include <string>

#include <gtest/gtest.h>

#include "protocol/base/utf8.hpp"

namespace dripline {

namespace {

TEST(OneLine, LeavesOrdinaryTextAlone) {
  EXPECT_EQ(one_line("run ended machine=lathe-1 \xC3\xA9"), "run ended machine=lathe-1 \xC3\xA9");
}

TEST(OneLine, LetsNoTextForgeAnEntryOrControlATerminal) {
  EXPECT_EQ(one_line("1.0\n2026 info run ended"), "1.0\\n2026 info run ended");
  EXPECT_EQ(one_line("\x1B[2J\r\x7F"), "\\x1b[2J\\x0d\\x7f");
  EXPECT_EQ(one_line(std::string_view("\0", 1)), "\\x00");
}

struct Utf8Case {
  std::string name;
  std::string text;
  std::size_t length;
};

class Utf8Length : public testing::TestWithParam<Utf8Case> {};

TEST_P(Utf8Length, IsThatOfTheFirstCharacter) {
  EXPECT_EQ(utf8_length(GetParam().text), GetParam().length);
}

INSTANTIATE_TEST_SUITE_P(
    , Utf8Length,
    testing::Values(
        Utf8Case{"ascii", "ab", 1}, Utf8Case{"nul", std::string(1, '\0'), 1},
        Utf8Case{"two_bytes", "\xC3\xA4x", 2}, Utf8Case{"three_bytes", "\xE2\x82\xACx", 3},
        Utf8Case{"four_bytes", "\xF0\x9F\x98\x80x", 4},
        Utf8Case{"last_of_all", "\xF4\x8F\xBF\xBF", 4}, Utf8Case{"continuation_first", "\x80", 0},
        Utf8Case{"cut_off", "\xE2\x82", 0}, Utf8Case{"no_continuation", "\xC3(", 0},
        Utf8Case{"overlong_two", "\xC1\x81", 0}, Utf8Case{"overlong_three", "\xE0\x9F\xBF", 0},
        Utf8Case{"overlong_four", "\xF0\x8F\xBF\xBF", 0}, Utf8Case{"surrogate", "\xED\xA0\x80", 0},
        Utf8Case{"beyond_the_last", "\xF4\x90\x80\x80", 0}, Utf8Case{"no_lead_byte", "\xFF", 0}),
    [](const auto& row) { return row.param.name; });

}  // namespace

}  // namespace dripline
