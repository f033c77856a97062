#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// An Ed25519 signature (RFC 8032), of a text by the holder of a key.
struct Signature {
  static constexpr std::size_t kSize = 64;
  std::array<std::byte, kSize> bytes{};
  friend bool operator==(const Signature&, const Signature&) = default;
  std::string hex() const;
};
/// Exactly 128 hexadecimal digits. Errors: Syntax.
Result<Signature> parse_signature(std::string_view hex);

/// The half of a key that everybody may have.
struct PublicKey {
  static constexpr std::size_t kSize = 32;
  std::array<std::byte, kSize> bytes{};
  friend bool operator==(const PublicKey&, const PublicKey&) = default;
  std::string hex() const;
};
/// Exactly 64 hexadecimal digits. Errors: Syntax.
Result<PublicKey> parse_public_key(std::string_view hex);

bool is_signed_by(const PublicKey& key, std::string_view text, const Signature& signature);

/// The half that signs. Any thread.
class SigningKey {
 public:
  /// `seed`: 64 hexadecimal digits, random and secret. Errors: Syntax.
  static Result<SigningKey> of(std::string_view seed);
  const PublicKey& public_key() const { return public_key_; }
  Signature sign(std::string_view text) const;

  static constexpr std::size_t kSeedBytes = 32;

 private:
  SigningKey() = default;
  std::array<std::byte, kSeedBytes> seed_{};
  PublicKey public_key_;
};

}  // namespace dripline
