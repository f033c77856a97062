#include "protocol/base/signature.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

/// RFC 8032, section 7.1.
struct Vector {
  const char* name;
  const char *seed, *public_key, *message, *signature;
};

class Ed25519 : public testing::TestWithParam<Vector> {};

TEST_P(Ed25519, SignsAsTheStandardDoes) {
  const Vector& vector = GetParam();
  const auto key = SigningKey::of(vector.seed);
  ASSERT_TRUE(key) << key.error().what;
  EXPECT_EQ(key->public_key().hex(), vector.public_key);
  EXPECT_EQ(key->sign(vector.message).hex(), vector.signature);
  const auto known = parse_public_key(vector.public_key);
  const auto signature = parse_signature(vector.signature);
  ASSERT_TRUE(known && signature);
  EXPECT_TRUE(is_signed_by(*known, vector.message, *signature));
}

INSTANTIATE_TEST_SUITE_P(
    , Ed25519,
    testing::Values(
        Vector{
            "empty", "9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60",
            "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
            "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39"
            "701cf9b46bd25bf5f0595bbe24655141438e7a100b"},
        Vector{
            "one_byte", "4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb",
            "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "\x72",
            "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f36"
            "13d0f11d8c387b2eaeb4302aeeb00d291612bb0c00"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(Signature, IsOfOneTextByOneKey) {
  const auto key = SigningKey::of(std::string(64, '1')).value();
  const auto other = SigningKey::of(std::string(64, '2')).value();
  const Signature signature = key.sign("release O0100");
  EXPECT_TRUE(is_signed_by(key.public_key(), "release O0100", signature));
  EXPECT_FALSE(is_signed_by(key.public_key(), "release O0101", signature));
  EXPECT_FALSE(is_signed_by(other.public_key(), "release O0100", signature));
  for (std::size_t i = 0; i < Signature::kSize; ++i) {
    Signature changed = signature;
    changed.bytes[i] ^= std::byte{1};
    EXPECT_FALSE(is_signed_by(key.public_key(), "release O0100", changed)) << i;
  }
  EXPECT_FALSE(is_signed_by(key.public_key(), "release O0100", Signature{}));
  EXPECT_FALSE(is_signed_by(PublicKey{}, "release O0100", signature));
}

TEST(Signature, IsReadFromExactlyItsDigits) {
  const std::string hex = SigningKey::of(std::string(64, 'a'))->sign("x").hex();
  EXPECT_EQ(parse_signature(hex)->hex(), hex);
  EXPECT_FALSE(parse_signature(hex.substr(2)));
  EXPECT_FALSE(parse_signature("g" + hex.substr(1)));
  EXPECT_FALSE(parse_public_key(""));
  EXPECT_FALSE(SigningKey::of(std::string(63, 'a')));
  EXPECT_FALSE(SigningKey::of(std::string(64, 'z')));
}

}  // namespace
}  // namespace dripline
