#include "gateway/app/run/block_texts.hpp"

#include <gtest/gtest.h>

namespace dripline::gateway {
namespace {

/// The blocks around the first place of `at` in a program whose text came over a line.
BlockTexts around(const std::string& program, const std::string& at, bool has_ended = true) {
  feed::LineFeed feed;
  feed.append(program);
  if (has_ended) feed.end();
  interpreter::Origin origin;
  origin.block = 1;
  origin.offset = program.find(at);
  return block_texts(feed, origin);
}

TEST(BlockTexts, AreTheLinesAroundTheExecutingOne) {
  const BlockTexts texts = around("%\nN1 G0 X1\nN2 G1 X2 F3\nN3 X4\nN4 X5\n", "N2");
  EXPECT_EQ(texts.previous, "N1 G0 X1");
  EXPECT_EQ(texts.block, "N2 G1 X2 F3");
  EXPECT_EQ(texts.next, "N3 X4");
  EXPECT_EQ(texts.further, "N4 X5");
}

TEST(BlockTexts, AreNoneBeyondTheProgram) {
  const BlockTexts first = around("N1 X1\nN2 X2\n", "N1");
  EXPECT_EQ(first.previous, "");
  EXPECT_EQ(first.next, "N2 X2");
  EXPECT_EQ(first.further, "");
  EXPECT_EQ(around("N1 X1\nN2 X2", "N2").block, "N2 X2") << "without a line end";
}

TEST(BlockTexts, PassOverBlankLinesAndWhatNoScreenShows) {
  const BlockTexts texts = around("N1\tX1\r\n\r\n  \r\nN2 X2  \r\n\r\nN3 X3\r\n", "N2");
  EXPECT_EQ(texts.previous, "N1 X1");
  EXPECT_EQ(texts.block, "N2 X2");
  EXPECT_EQ(texts.next, "N3 X3");
}

/// Of a program larger than memory only what is buffered is known.
TEST(BlockTexts, AreOnlyWhatIsAtHand) {
  const BlockTexts texts = around("N1 X1\nN2 X2\nN3 X", "N1", false);
  EXPECT_EQ(texts.next, "N2 X2");
  EXPECT_EQ(texts.further, "") << "half a block is none";
  const std::string longer = "N1 X1\n" + std::string(9000, 'X') + "\nN2 X2\n";
  EXPECT_EQ(around(longer, "N2").previous, "") << "its begin is out of reach";
  EXPECT_EQ(around(longer, "N1").next, "") << "its end is";
  feed::LineFeed nothing;
  EXPECT_EQ(block_texts(nothing, {}).next, "");
}

TEST(BlockTexts, OfAProgramThatHasNotBegunAreItsFirst) {
  feed::LineFeed feed;
  feed.append("%\nN1 X1\n");
  feed.end();
  const BlockTexts texts = block_texts(feed, {});
  EXPECT_EQ(texts.block, "");
  EXPECT_EQ(texts.next, "%");
  EXPECT_EQ(texts.further, "N1 X1");
}

TEST(BlockTexts, AreCutAtWhatAStatusHolds) {
  const std::string text = "N1 (" + std::string(300, 'x') + ")\n";
  EXPECT_LE(around(text, "N1").block.size(), dds::kMaxBlockText);
}

}  // namespace
}  // namespace dripline::gateway
