#include "storage/cache/list_file.hpp"

#include <gtest/gtest.h>

#include "storage/programs/chunk_codec.hpp"

namespace dripline::cache {
namespace {

using storage::ContentList;
using storage::kChunkBytes;

const Digest kContent = sha256("a content");

ContentList list_of(std::uint64_t size) {
  ContentList list{size, {}};
  for (std::uint64_t at = 0; at < size; at += kChunkBytes)
    list.chunks.push_back(sha256(std::to_string(at)));
  return list;
}

/// With a checksum that fits.
std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
  bytes.resize(bytes.size() - Digest::kSize);
  const Digest checksum = sha256(bytes);
  bytes.insert(bytes.end(), checksum.bytes.begin(), checksum.bytes.end());
  return bytes;
}

class ListSize : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ListSize, IsReadAsItWasWritten) {
  const auto list = list_of(GetParam());
  EXPECT_EQ(read_list(kContent, to_bytes(kContent, list)), list);
}

INSTANTIATE_TEST_SUITE_P(, ListSize,
                         testing::Values(0, 1, kChunkBytes - 1, kChunkBytes, kChunkBytes + 1,
                                         100 * kChunkBytes));

TEST(ListFile, IsNoneWithAnyBitChanged) {
  const auto whole = to_bytes(kContent, list_of(3 * kChunkBytes));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto bytes = whole;
    bytes[at] ^= std::byte{0x10};
    EXPECT_FALSE(read_list(kContent, bytes)) << at;
  }
}

TEST(ListFile, IsNoneWithAnyLengthButItsOwn) {
  const auto whole = to_bytes(kContent, list_of(3 * kChunkBytes));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(read_list(kContent, std::span(whole).first(length))) << length;
  auto longer = whole;
  longer.resize(whole.size() + Digest::kSize);
  EXPECT_FALSE(read_list(kContent, longer));
}

TEST(ListFile, IsNoneOfAnotherContent) {
  EXPECT_FALSE(read_list(sha256("another"), to_bytes(kContent, list_of(10))));
}

TEST(ListFile, IsNoneWhoseSizeIsNotThatOfItsChunksThoughItsChecksumFits) {
  for (const std::uint64_t size :
       {std::uint64_t{0}, 2 * kChunkBytes, 3 * kChunkBytes + 1, ~std::uint64_t{0}}) {
    auto list = list_of(3 * kChunkBytes);
    list.size = size;
    EXPECT_FALSE(read_list(kContent, to_bytes(kContent, list))) << size;
  }
}

TEST(ListFile, IsNoneOfAnotherFormatThoughItsChecksumFits) {
  auto bytes = to_bytes(kContent, list_of(10));
  ASSERT_TRUE(read_list(kContent, sealed(bytes)));
  bytes[7] = std::byte{'2'};
  EXPECT_FALSE(read_list(kContent, sealed(bytes)));
}

}  // namespace
}  // namespace dripline::cache
