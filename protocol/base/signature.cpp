#include "protocol/base/signature.hpp"

#include <openssl/evp.h>
#include <memory>
#include <span>

#include "protocol/base/hex.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline {
namespace {

using EvpKey = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using EvpContext = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

const unsigned char* octets(const std::byte* bytes) {
  return reinterpret_cast<const unsigned char*>(bytes);
}
const unsigned char* octets(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

EvpKey private_key(std::span<const std::byte> seed) {
  EvpKey key(
      EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, octets(seed.data()), seed.size()),
      EVP_PKEY_free);
  invariant(key != nullptr, "Ed25519 is available");
  return key;
}

template <class Bytes>
Result<Bytes> parse_bytes(std::string_view hex, std::string_view what) {
  Bytes parsed;
  if (parse_hex(hex, parsed.bytes)) return parsed;
  return fail(Errc::Syntax, "{} has {} hexadecimal digits, got {} characters", what,
              2 * Bytes::kSize, hex.size());
}

}  // namespace

std::string Signature::hex() const {
  return hex_text(bytes);
}
std::string PublicKey::hex() const {
  return hex_text(bytes);
}
Result<Signature> parse_signature(std::string_view hex) {
  return parse_bytes<Signature>(hex, "an Ed25519 signature");
}
Result<PublicKey> parse_public_key(std::string_view hex) {
  return parse_bytes<PublicKey>(hex, "a public key");
}

bool is_signed_by(const PublicKey& key, std::string_view text, const Signature& signature) {
  const EvpKey known(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr,
                                                 octets(key.bytes.data()), key.bytes.size()),
                     EVP_PKEY_free);
  const EvpContext context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  return known != nullptr && context != nullptr &&
         EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, known.get()) == 1 &&
         EVP_DigestVerify(context.get(), octets(signature.bytes.data()), signature.bytes.size(),
                          octets(text), text.size()) == 1;
}

Result<SigningKey> SigningKey::of(std::string_view seed) {
  SigningKey key;
  if (!parse_hex(seed, key.seed_)) {
    return fail(Errc::Syntax, "a signing key has {} hexadecimal digits, got {} characters",
                2 * kSeedBytes, seed.size());
  }
  std::size_t size = PublicKey::kSize;
  auto* const to = reinterpret_cast<unsigned char*>(key.public_key_.bytes.data());
  const bool is_made = EVP_PKEY_get_raw_public_key(private_key(key.seed_).get(), to, &size) == 1 &&
                       size == PublicKey::kSize;
  invariant(is_made, "an Ed25519 key has a public half");
  return key;
}

Signature SigningKey::sign(std::string_view text) const {
  const EvpKey key = private_key(seed_);
  const EvpContext context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  Signature signature;
  std::size_t size = Signature::kSize;
  const bool is_made =
      context != nullptr &&
      EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
      EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.bytes.data()), &size,
                     octets(text), text.size()) == 1;
  invariant(is_made && size == Signature::kSize, "a text can be signed");
  return signature;
}

}  // namespace dripline
