#include "protocol/base/digest.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

constexpr auto kAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";  // FIPS 180-4

TEST(Sha256, MatchesThePublishedVector) {
  EXPECT_EQ(sha256("abc").hex(), kAbc);
}

TEST(Sha256, GivesTheSameDigestHoweverTheTextIsCut) {
  Sha256 hash;
  hash.update("a");
  EXPECT_EQ(hash.digest(), sha256("a"));
  hash.update("bc");
  EXPECT_EQ(hash.digest().hex(), kAbc);
}

TEST(ParseDigest, RoundTrips) {
  const auto digest = parse_digest(kAbc);
  ASSERT_TRUE(digest);
  EXPECT_EQ(digest->hex(), kAbc);
}

TEST(ParseDigest, RefusesWrongLengthAndWrongDigits) {
  EXPECT_FALSE(parse_digest("ba78"));
  EXPECT_FALSE(parse_digest(std::string(64, 'g')));
}

TEST(Crc32, MatchesThePublishedCheckValue) {
  const std::string_view text = "123456789";
  EXPECT_EQ(crc32(std::as_bytes(std::span(text))), 0xCBF43926u);
}

TEST(Crc32, IsTheSameHoweverTheBytesAreCut) {
  std::string text(1000, 'x');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 7);
  const auto bytes = std::as_bytes(std::span(text));
  for (const std::size_t cut : {0u, 1u, 15u, 16u, 255u, 999u, 1000u}) {
    EXPECT_EQ(crc32(bytes.subspan(cut), crc32(bytes.first(cut))), crc32(bytes)) << cut;
  }
  EXPECT_EQ(crc32({}), 0u);
}

}  // namespace
}  // namespace dripline
