#include "protocol/audit/attestation.hpp"

#include <gtest/gtest.h>

namespace dripline::audit {
namespace {

const SigningKey& own_key() {
  static const SigningKey kKey = SigningKey::of(std::string(64, '7')).value();
  return kKey;
}
std::string sample() {
  return attestation_text({{"run", "r1"}, {"reason", ""}, {"text", "two\nlines \\ \xc3\xa9"}},
                          own_key());
}

TEST(Attestation, IsReadWithoutTheServer) {
  const auto read = parse_attestation(sample());
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->facts.size(), 3u);
  EXPECT_EQ(read->value("text"), "two\nlines \\ \xc3\xa9");
  EXPECT_EQ(read->value("reason"), "");
  EXPECT_EQ(read->value("none"), "");
  EXPECT_EQ(read->key, own_key().public_key());
}

TEST(Attestation, OfWhichAnyByteWasChangedIsNone) {
  const std::string good = sample();
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const int bit : {1, 32}) {
      std::string other = good;
      other[at] = static_cast<char>(other[at] ^ bit);
      // Digits of either case are the same key and signature.
      const auto read = parse_attestation(other);
      if (read) {
        EXPECT_EQ(read->facts, parse_attestation(good)->facts) << at;
        EXPECT_GT(at, good.find("\npublic_key")) << at;
      }
    }
    EXPECT_FALSE(parse_attestation(good.substr(0, at))) << at;
  }
  EXPECT_FALSE(parse_attestation(good + "x y\n"));
  EXPECT_EQ(parse_attestation(good + std::string(kMaxAttestation, ' ')).error().code,
            Errc::LimitExceeded);
}

TEST(Attestation, WithAnothersKeyNamesThatKey) {
  const SigningKey other = SigningKey::of(std::string(64, '8')).value();
  std::string forged = sample();
  const std::string own = own_key().public_key().hex();
  forged.replace(forged.find(own), own.size(), other.public_key().hex());
  EXPECT_EQ(parse_attestation(forged).error().code, Errc::Corrupt);
  EXPECT_EQ(parse_attestation(attestation_text({{"run", "r1"}}, other))->key, other.public_key());
}

}  // namespace
}  // namespace dripline::audit
