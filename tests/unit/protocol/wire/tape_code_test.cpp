#include "protocol/wire/tape_code.hpp"

#include <gtest/gtest.h>
#include <bit>
#include <string>
#include <vector>

namespace dripline::wire {
namespace {

using enum CharacterCode;

std::vector<std::byte> bytes(std::string_view text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

std::vector<std::byte> punched(CharacterCode code, std::string_view text) {
  std::vector<std::byte> rows;
  for (const char c : text) rows.push_back(static_cast<std::byte>(encode_row(code, c).value()));
  return rows;
}

TEST(TapeCode, PunchesTheSameBlockInBothCodes) {
  const std::string_view block = "%\nN7G1X-2M03 /+.,\n";
  EXPECT_EQ(punched(Eia, block),
            bytes("\x0B\x80\x45\x07\x67\x01\x37\x40\x02\x54\x20\x13\x10\x31\x70"
                  "\x6B\x3B\x80"));
  EXPECT_EQ(punched(Iso, block),
            bytes("\xA5\x0A\x4E\xB7\x47\xB1\xD8\x2D\xB2\x4D\x30\x33\xA0\xAF\x2B"
                  "\x2E\xAC\x0A"));
  EXPECT_EQ(punched(Ascii, block), bytes(block));
}

TEST(TapeCode, HasTheParityOfItsCodeInEveryCharacter) {
  for (unsigned c = 0; c < 128; ++c) {
    if (const auto row = encode_row(Eia, static_cast<char>(c), true)) {
      EXPECT_EQ(std::popcount(*row) % 2, 1) << c;
      EXPECT_EQ(decode_row(Eia, *row).character, static_cast<char>(c));
    }
    if (const auto row = encode_row(Iso, static_cast<char>(c))) {
      EXPECT_EQ(std::popcount(*row) % 2, 0) << c;
      EXPECT_EQ(decode_row(Iso, *row).character, static_cast<char>(c));
    }
  }
}

TEST(TapeCode, KnowsEveryRowOfEia) {
  std::size_t text = 0, unassigned = 0, wrong = 0;
  for (unsigned row = 0; row < 256; ++row) {
    const auto kind = decode_row(Eia, static_cast<std::uint8_t>(row)).kind;
    text += kind == RowKind::Text;
    unassigned += kind == RowKind::Unassigned;
    wrong += kind == RowKind::WrongParity;
  }
  EXPECT_EQ(text, 36U + 7U + 3U);  // letters and digits; + - . , / & and the blank; TAB ( )
  EXPECT_EQ(wrong, 127U);          // all even rows but the blank one
  EXPECT_EQ(unassigned, 128U - 46U - 6U);
}

TEST(TapeCode, DeletesEverythingButTheEndOfBlockOfEia) {
  EXPECT_EQ(decode_row(Eia, 0x7F).kind, RowKind::Delete);
  EXPECT_EQ(decode_row(Iso, 0xFF).kind, RowKind::Delete);
  EXPECT_EQ(decode_row(Eia, 0x80 | 0x7F).kind, RowKind::WrongParity);
  EXPECT_EQ(delete_row(Iso), 0xFF);
  EXPECT_EQ(delete_row(Eia), 0x7F);
}

TEST(TapeCode, HasNoEiaRowForWhatEiaCannotSay) {
  for (const char c : std::string_view("()#:;=*$'\"<>?@![]a")) {
    EXPECT_FALSE(encode_row(Eia, c)) << c;
  }
  EXPECT_EQ(encode_row(Eia, '(', true), 0x1A);
  EXPECT_EQ(encode_row(Eia, ')', true), 0x4A);
}

TEST(TapeCode, SeesOneFlippedHole) {
  for (const char c : std::string_view("N0123456789X-\n%")) {
    for (unsigned track = 0; track < 8; ++track) {
      const auto flip = static_cast<std::uint8_t>(1U << track);
      const auto eia = static_cast<std::uint8_t>(*encode_row(Eia, c) ^ flip);
      const auto iso = static_cast<std::uint8_t>(*encode_row(Iso, c) ^ flip);
      EXPECT_FALSE(has_right_parity(Eia, eia) && eia != 0);
      EXPECT_FALSE(has_right_parity(Iso, iso));
    }
  }
}

struct Tape {
  const char* name;
  CharacterCode code;
  std::string title;  ///< any punching before the rewind stop
  std::size_t first_block;
};

class DetectTapeCode : public testing::TestWithParam<Tape> {};

TEST_P(DetectTapeCode, FindsTheCodeAndTheFirstBlock) {
  const auto& tape = GetParam();
  auto rows = bytes(tape.title);
  for (const auto row : punched(tape.code, "%\nN1G1X5Y7\nN2X12347Y8\nN3M30\n")) rows.push_back(row);
  rows.resize(rows.size() + 120);
  const auto verdict = detect_code(rows);
  ASSERT_TRUE(verdict) << verdict.error().what;
  EXPECT_EQ(verdict->code, tape.code);
  EXPECT_EQ(verdict->first_block, tape.first_block);
  EXPECT_GT(verdict->confidence, 0.97);
}

INSTANTIATE_TEST_SUITE_P(
    , DetectTapeCode,
    testing::Values(Tape{"eia", Eia, "", 1}, Tape{"iso", Iso, "", 1}, Tape{"ascii", Ascii, "", 1},
                    Tape{"eia_after_blanks", Eia, std::string(200, '\0'), 201},
                    Tape{"eia_title_with_line_feeds", Eia, "\x7E\x0A\x0A\x8D\x7E", 6},
                    Tape{"iso_title_with_track_eight", Iso, "\xFE\x80\x80\x92\xFE", 6}),
    [](const auto& tested) { return std::string(tested.param.name); });

struct CommentedText {
  const char* name;
  std::string text;
};
class DetectText : public testing::TestWithParam<CommentedText> {};

/// Short programs, whose comments are a good part of them.
TEST_P(DetectText, IsNoTapeWhateverItsComments) {
  const auto verdict = detect_code(bytes(GetParam().text));
  ASSERT_TRUE(verdict) << verdict.error().what;
  EXPECT_EQ(verdict->code, Ascii);
}

INSTANTIATE_TEST_SUITE_P(
    , DetectText,
    testing::Values(CommentedText{"one_umlaut", "O0815 (\xC3\x98 12 BOHRER)\nG0X0\nM30\n"},
                    CommentedText{"one_latin_1_umlaut", "O0815 (\xD8 12 BOHRER)\nG0X0\nM30\n"},
                    CommentedText{"cyrillic",
                                  "(\xD0\xA1\xD0\xB2\xD0\xB5\xD1\x80\xD0\xBB\xD0\xBE)\nG0X0\n"},
                    CommentedText{"chinese", "(\xE9\x92\xBB\xE5\xAD\x94)\nG0X1\nM30\n"},
                    CommentedText{"byte_order_mark", "\xEF\xBB\xBF%\nO1\nG0X1\nM30\n%\n"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(DetectCode, RefusesWhatIsNoTape) {
  const auto nothing = detect_code({});
  EXPECT_FALSE(nothing);
  const auto noise = detect_code(bytes("\xC3\x28\xA0\xA1\xE2\x82\x28\xF0\x28\x8C\xBC"));
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().code, Errc::Corrupt);
  EXPECT_NE(noise.error().what.find("of 11 rows"), std::string::npos) << noise.error().what;
}

}  // namespace
}  // namespace dripline::wire
