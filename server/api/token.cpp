#include "server/api/token.hpp"

#include <openssl/crypto.h>

#include "protocol/base/digest.hpp"

namespace dripline::api {

bool is_authorized(const Token& token, const std::string& authorization) {
  constexpr std::string_view kScheme = "Bearer ";
  if (token.secret.empty() || !authorization.starts_with(kScheme)) return false;
  // Digests have one length, so the time does not depend on the token's length either.
  const Digest given = sha256(std::string_view(authorization).substr(kScheme.size()));
  const Digest right = sha256(token.secret);
  return CRYPTO_memcmp(given.bytes.data(), right.bytes.data(), Digest::kSize) == 0;
}

}  // namespace dripline::api
