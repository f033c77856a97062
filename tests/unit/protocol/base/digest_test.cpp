#include "protocol/base/digest.hpp"

#include <gtest/gtest.h>

#include "protocol/base/crc32.hpp"

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

}  // namespace
}  // namespace dripline
