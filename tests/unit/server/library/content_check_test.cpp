#include "server/library/content_check.hpp"

#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <string_view>

namespace dripline::library {
namespace {

using namespace std::string_literals;

/// The verdict over `text` cut into pieces of `piece` bytes.
Result<void> judge(std::string_view text, std::size_t piece) {
  ContentCheck check;
  for (std::size_t at = 0; at < text.size(); at += piece) {
    if (auto good = check.feed(std::as_bytes(std::span(text.substr(at, piece)))); !good) {
      return good;
    }
  }
  return check.finish();
}

struct TextCase {
  const char* name;
  std::string text;
  std::optional<Errc> error;
  const char* says = "";
};

class ContentCheckTest : public testing::TestWithParam<TextCase> {};

TEST_P(ContentCheckTest, JudgesTheSameHoweverTheTextIsCut) {
  const TextCase& c = GetParam();
  for (const std::size_t piece :
       {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{1} << 20}) {
    const auto verdict = judge(c.text, piece);
    ASSERT_EQ(verdict.has_value(), !c.error) << "pieces of " << piece;
    if (!c.error) continue;
    EXPECT_EQ(verdict.error().code, *c.error);
    EXPECT_NE(verdict.error().what.find(c.says), std::string::npos) << verdict.error().what;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ContentCheckTest,
    testing::Values(
        TextCase{"plain", "O1\r\nG0 X1\tZ2\nM30", {}},
        TextCase{"two_three_and_four_byte_characters", "(\u00e4\u20ac\U0001F600)\n", {}},
        TextCase{"first_and_last_code_points", "\xC2\x80\xEF\xBF\xBF\xF4\x8F\xBF\xBF", {}},
        TextCase{"empty", "", Errc::Syntax, "empty"},
        TextCase{"nul", "O1\nX\0Y"s, Errc::Syntax, "NUL) at offset 4, line 2"},
        TextCase{"latin_1", "O1\n(\xE4)\n", Errc::Syntax, "0x29 at offset 5, line 2"},
        TextCase{"continuation_first", "\x80", Errc::Syntax, "UTF-8"},
        TextCase{"overlong_slash", "\xC0\xAF", Errc::Syntax, "0xC0 at offset 0"},
        TextCase{"overlong_three", "\xE0\x80\x80", Errc::Syntax, "UTF-8"},
        TextCase{"overlong_four", "\xF0\x8F\xBF\xBF", Errc::Syntax, "UTF-8"},
        TextCase{"surrogate", "\xED\xA0\x80", Errc::Syntax, "UTF-8"},
        TextCase{"after_unicode", "\xF4\x90\x80\x80", Errc::Syntax, "UTF-8"},
        TextCase{"ends_inside_a_character", "X\xE2\x82", Errc::Syntax, "ends at offset 3"},
        TextCase{"longest_line", std::string(65536, 'X') + "\nM30", {}},
        TextCase{"line_too_long", "O1\n" + std::string(65537, 'X'), Errc::LimitExceeded,
                 "line 2 is longer than 65536"}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::library
