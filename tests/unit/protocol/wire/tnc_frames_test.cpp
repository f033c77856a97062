#include "protocol/wire/tnc_frames.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace dripline::wire {
namespace {

using Kind = TncFrame::Kind;

const HeidenhainSettings kTnc;

std::vector<TncFrame> frames(std::string_view characters, const HeidenhainSettings& tnc = kTnc) {
  TncFrameReader reader(tnc);
  std::vector<TncFrame> all;
  for (const char c : characters) {
    if (auto frame = reader.read(static_cast<std::uint8_t>(c))) all.push_back(*frame);
  }
  return all;
}

struct Check {
  const char* name;
  char begin;
  std::string text;
  bool line_end, printable;
  char check;
};

class TncBlock : public testing::TestWithParam<Check> {};

// Rows: HD-223 (check character).
TEST_P(TncBlock, HasItsCheckCharacterAndIsReadBack) {
  const auto& tested = GetParam();
  HeidenhainSettings tnc;
  tnc.line_end_in_block = tested.line_end;
  tnc.bcc_is_printable = tested.printable;
  const auto block = make_tnc_block(tested.begin, tested.text, tnc);
  EXPECT_EQ(block.front(), tested.begin);
  EXPECT_EQ(block.back(), tested.check);
  const auto read = frames(block, tnc);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].kind, tested.begin == 1 ? Kind::Heading : Kind::Block);
  EXPECT_EQ(read[0].text, tested.text);
}

INSTANTIATE_TEST_SUITE_P(
    , TncBlock,
    testing::Values(Check{"input", 1, "%27E", false, false, 0x73},
                    Check{"output_of_a_plain_program", 1, "H4A", false, false, 0x2B},
                    Check{"output_without_a_number", 1, "%A", false, false, 0x72},
                    Check{"line", 2, "3 L X+7,5 R0 F40", false, false, 0x17},
                    Check{"line_with_its_end", 2, "3 L X+7,5 R0 F40", true, false, 0x10},
                    Check{"printable", 2, "3 L X+7,5 R0 F40", false, true, 0x37},
                    Check{"printable_with_its_end", 2, "3 L X+7,5 R0 F40", true, true, 0x30},
                    Check{"printable_anyway", 1, "%27E", false, true, 0x73}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(TncFrames, FindEverySpoiledBit) {
  const auto block = make_tnc_block(2, "12 CALL LBL 4 REP 2/2", kTnc);
  for (std::size_t at = 1; at < block.size(); ++at) {
    for (int bit = 0; bit < 7; ++bit) {
      auto spoiled = block;
      spoiled[at] = static_cast<char>(spoiled[at] ^ (1 << bit));
      for (const auto& frame : frames(spoiled)) EXPECT_NE(frame.kind, Kind::Block) << at;
    }
  }
}

TEST(TncFrames, FindEveryLostAndEveryDoubledCharacter) {
  const auto block = make_tnc_block(2, "12 CALL LBL 4 REP 2/2", kTnc);
  for (std::size_t at = 0; at < block.size(); ++at) {
    const auto lost = std::string(block).erase(at, 1),
               twice = std::string(block).insert(at, 1, block[at]);
    for (const auto& frame : frames(lost)) EXPECT_NE(frame.kind, Kind::Block) << at;
    for (const auto& frame : frames(twice)) {
      // STX twice begins twice; the check character twice leaves one character over.
      EXPECT_TRUE(frame.kind != Kind::Block || at == 0 || at + 1 == block.size()) << at;
    }
  }
}

TEST(TncFrames, RestartWhereABlockBeginsInsideAnother) {
  const auto block = make_tnc_block(2, "1 STOP", kTnc);
  const auto read = frames(block.substr(0, 5) + block);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].text, "1 STOP");
}

TEST(TncFrames, TakeTheReplacementsOfTheirCharacters) {
  HeidenhainSettings tnc;
  tnc.soh = '#';
  tnc.stx = '$';
  tnc.etb = '&';
  tnc.ack = '!';
  const auto block = make_tnc_block(tnc.stx, "5 L Z-2", tnc);
  EXPECT_EQ(block.front(), '$');
  const auto read = frames("!" + block, tnc);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].kind, Kind::Ack);
  EXPECT_EQ(read[1].text, "5 L Z-2");
}

TEST(TncFrames, AreBounded) {
  std::string endless(1, 2);
  endless += std::string(5000, 'X');
  endless += "\x17Q";
  const auto read = frames(endless);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].kind, Kind::Broken);
  EXPECT_EQ(read[0].text, "longer than a block can be");
}

}  // namespace
}  // namespace dripline::wire
