#include "gateway/feed/chunk_cache.hpp"

#include <gtest/gtest.h>

namespace dripline::feed {
namespace {

constexpr std::size_t kChunk = ChunkCache::kChunkBytes;

std::string letters(std::size_t bytes) {
  std::string text(bytes, ' ');
  for (std::size_t i = 0; i < bytes; ++i) text[i] = static_cast<char>('a' + i % 26);
  return text;
}

TEST(HeldText, IsWhatLiesAroundAByteWithoutAGap) {
  ChunkCache cache(8 * kChunk);
  const std::string text = letters(2 * kChunk + 100);
  cache.store(0, 0, text);
  const HeldText held = cache.around(0, kChunk, 50);
  EXPECT_EQ(held.offset, kChunk - 50);
  EXPECT_EQ(held.text, text.substr(kChunk - 50, 100)) << "across two chunks";
  EXPECT_EQ(cache.around(0, 10, 50).offset, 0U);
  EXPECT_EQ(cache.around(0, 2 * kChunk + 90, 50).end(), text.size());
  EXPECT_EQ(cache.around(1, 10, 50).text, "") << "another program";
}

TEST(HeldText, BeginsAfterAGapAndEndsBeforeOne) {
  ChunkCache cache(8 * kChunk);
  const std::string text = letters(kChunk);
  cache.store(0, kChunk, text);
  const HeldText held = cache.around(0, kChunk + 10, 50);
  EXPECT_EQ(held.offset, kChunk);
  EXPECT_EQ(held.text, text.substr(0, 60));
  EXPECT_EQ(cache.around(0, 2 * kChunk - 10, 50).text, text.substr(kChunk - 60));
  EXPECT_EQ(cache.around(0, kChunk - 1, 50).text, "") << "that byte itself is not held";
  EXPECT_EQ(cache.around(0, 2 * kChunk, 50).text, "");
}

}  // namespace
}  // namespace dripline::feed
