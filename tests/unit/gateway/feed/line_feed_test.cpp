#include "gateway/feed/line_feed.hpp"

#include <gtest/gtest.h>

namespace dripline::feed {
namespace {

using State = interpreter::TextWindow::State;

std::string program(std::size_t size) {
  std::string text;
  for (int line = 1; text.size() < size; ++line) text += "N" + std::to_string(line) + " G1 X2.5\n";
  return text;
}

TEST(LineFeed, GivesTextAsItComes) {
  LineFeed feed;
  EXPECT_EQ(feed.fetch(0, 0, 1).state, State::NotYet);
  feed.append("G0 X1\nG1");
  auto window = feed.fetch(0, 0, 1);
  ASSERT_EQ(window.state, State::Ready);
  EXPECT_EQ(window.text, "G0 X1\nG1");
  EXPECT_FALSE(window.reaches_end);
  EXPECT_EQ(feed.fetch(0, 6, 3).state, State::NotYet);
  feed.append(" Z2\n");
  feed.end();
  window = feed.fetch(0, 6, 3);
  EXPECT_EQ(window.text, "G1 Z2\n");
  EXPECT_TRUE(window.reaches_end);
  EXPECT_TRUE(feed.fetch(0, 12, 1).reaches_end);
  EXPECT_EQ(feed.fetch(0, 12, 1).text, "");
}

TEST(LineFeed, KeepsAWindowWhileMoreTextComes) {
  LineFeed feed;
  feed.append("N1 G0\n");
  const auto window = feed.fetch(0, 0, 1);
  for (int i = 0; i < 100; ++i) feed.append(program(1000));
  EXPECT_EQ(window.text, "N1 G0\n");
}

TEST(LineFeed, GivesWhatCameBeforeABreakAndNothingOfTheBlockThatBroke) {
  LineFeed feed;
  feed.append("G0 X1\nG1 X12");
  feed.break_off("line: hung up");
  EXPECT_EQ(feed.fetch(0, 0, 6).state, State::Ready);
  const auto window = feed.fetch(0, 6, 7);
  EXPECT_EQ(window.state, State::Failed);
  EXPECT_EQ(window.reason, "line: hung up");
}

TEST(LineFeed, TellsWhatIsUsedUp) {
  LineFeed feed;
  feed.append(program(10'000));
  EXPECT_EQ(feed.consumed(), 0U);
  (void)feed.fetch(0, 3000, 1);
  EXPECT_EQ(feed.consumed(), 3000U);
  (void)feed.fetch(0, 500, 1);
  EXPECT_EQ(feed.consumed(), 3000U) << "a loop needs no new text";
}

TEST(LineFeed, AsksForRoomWhenABlockIsNotComplete) {
  LineFeed feed;
  feed.append(std::string(4096, 'X'));
  EXPECT_EQ(feed.fetch(0, 0, 4097).state, State::NotYet);
  EXPECT_EQ(feed.consumed(), 4096U) << "or a block longer than the memory would never come";
}

TEST(LineFeed, ReadsAcrossChunksAndBack) {
  LineFeed feed;
  const std::string text = program(200'000);
  for (std::size_t at = 0; at < text.size(); at += 777)
    feed.append(std::string_view(text).substr(at, 777));
  feed.end();
  for (std::size_t at = 0; at < text.size(); at += 4093) {
    const auto window = feed.fetch(0, at, 3000);
    ASSERT_EQ(window.state, State::Ready);
    ASSERT_GE(window.text.size(), std::min<std::size_t>(3000, text.size() - at));
    ASSERT_EQ(window.text, std::string_view(text).substr(at, window.text.size()));
  }
  EXPECT_EQ(feed.fetch(0, 0, 100).text.substr(0, 100), text.substr(0, 100));
  EXPECT_EQ(feed.sent(), text.size());
  EXPECT_EQ(feed.content_digest(), sha256(text));
}

TEST(LineFeed, RefusesAJumpBeyondWhatIsKept) {
  LineFeed feed(4 * ChunkCache::kChunkBytes);
  const std::string text = program(10 * ChunkCache::kChunkBytes);
  for (std::size_t at = 0; at < text.size(); at += 1000) {
    feed.append(std::string_view(text).substr(at, 1000));
    (void)feed.fetch(0, at, 1);
  }
  const auto window = feed.fetch(0, 100, 10);
  EXPECT_EQ(window.state, State::Failed);
  EXPECT_NE(window.reason.find("byte 100 of the program is gone"), std::string::npos);
  EXPECT_EQ(feed.fetch(0, text.size() - 2 * ChunkCache::kChunkBytes, 10).state, State::Ready);
}

TEST(LineFeed, KnowsNoOtherPrograms) {
  LineFeed feed;
  EXPECT_EQ(feed.find("O0002").state, interpreter::ProgramLookup::State::NotFound);
  EXPECT_EQ(feed.fetch(1, 0, 1).state, State::Failed);
}

}  // namespace
}  // namespace dripline::feed
