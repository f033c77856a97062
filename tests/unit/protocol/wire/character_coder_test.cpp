#include "protocol/wire/character_coder.hpp"

#include <gtest/gtest.h>
#include <span>
#include <vector>

#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {
namespace {

using enum CharacterCode;

std::vector<std::byte> bytes(std::string_view text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

std::string decoded(CharacterCode code, const std::vector<std::byte>& line) {
  CharacterDecoder decoder(code);
  std::string text;
  for (const auto character : line) {
    if (const auto got = decoder.decode(character); got.text) text += *got.text;
  }
  return text;
}

struct Form {
  const char* name;
  CharacterCode code;
  EndOfBlock end_of_block;
};

class CharacterCoder : public testing::TestWithParam<Form> {};

TEST_P(CharacterCoder, GivesTheTextBackHoweverItIsCut) {
  const auto& form = GetParam();
  const std::string text = "%\nN10 G01 X-1.25,Y+3\n\n\nN20/M30\n%\n";
  CharacterEncoder whole(form.code, form.end_of_block), pieces(form.code, form.end_of_block);
  std::vector<std::byte> line, cut;
  ASSERT_TRUE(whole.encode(text, line));
  for (const char c : text) ASSERT_TRUE(pieces.encode({&c, 1}, cut));
  EXPECT_EQ(line, cut);
  EXPECT_EQ(decoded(form.code, line), text);
  EXPECT_EQ(whole.blocks(), 6U);
}

INSTANTIATE_TEST_SUITE_P(, CharacterCoder,
                         testing::Values(Form{"ascii_lf", Ascii, EndOfBlock::Lf},
                                         Form{"ascii_cr", Ascii, EndOfBlock::Cr},
                                         Form{"ascii_crlf", Ascii, EndOfBlock::CrLf},
                                         Form{"ascii_lfcr", Ascii, EndOfBlock::LfCr},
                                         Form{"iso_lfcrcr", Iso, EndOfBlock::LfCrCr},
                                         Form{"iso_crlf", Iso, EndOfBlock::CrLf},
                                         Form{"eia", Eia, EndOfBlock::CrLf}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(CharacterEncoder, NamesLineAndColumnOfWhatTheCodeDoesNotHave) {
  CharacterEncoder encoder(Eia, EndOfBlock::CrLf);
  std::vector<std::byte> line;
  ASSERT_TRUE(encoder.encode("G1\nG2\nX4", line));
  const auto before = line;
  const auto refused = encoder.encode("Y(9", line);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Syntax);
  EXPECT_EQ(refused.error().what, "line 3, column 4: '(' is not a character of the EIA code");
  EXPECT_EQ(line, before);
}

TEST(CharacterEncoder, RefusesControlCharactersAndTheEighthBit) {
  for (const std::string_view text : {"\x13", "\x03", "\xC4", "\x7F", "\rG1"}) {
    CharacterEncoder encoder(Ascii, EndOfBlock::CrLf);
    std::vector<std::byte> line;
    EXPECT_FALSE(encoder.encode(text, line)) << text;
  }
}

TEST(CharacterEncoder, TakesCarriageReturnsBeforeLineFeeds) {
  CharacterEncoder encoder(Ascii, EndOfBlock::Lf);
  std::vector<std::byte> line;
  ASSERT_TRUE(encoder.encode("G1\r", line));
  ASSERT_TRUE(encoder.encode("\nG2\r\n", line));
  EXPECT_EQ(line, bytes("G1\nG2\n"));
}

TEST(CharacterDecoder, LeavesOutBlanksDeletesAndControlCharacters) {
  EXPECT_EQ(decoded(Iso, bytes(std::string_view("\0\xFF\x11\xB1\x87\x8D\n", 7))), "1\n");
}

TEST(CharacterDecoder, PutsAQuestionMarkWhereItCannotRead) {
  CharacterDecoder decoder(Iso);
  ASSERT_EQ(decoder.decode(std::byte{0x47}).text, 'G');
  const auto wrong = decoder.decode(std::byte{0x31});
  EXPECT_EQ(wrong.text, '?');
  ASSERT_TRUE(wrong.error);
  EXPECT_EQ(wrong.error->code, Errc::Corrupt);
  EXPECT_EQ(wrong.error->what, "line 1, column 2: 0x31 has not the parity of the ISO code");
}

}  // namespace
}  // namespace dripline::wire
