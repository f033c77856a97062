#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// A SHA-256 digest. Program revisions and stored chunks are addressed by it.
struct Digest {
  static constexpr std::size_t kSize = 32;
  std::array<std::byte, kSize> bytes{};

  std::string hex() const;
  friend auto operator<=>(const Digest&, const Digest&) = default;
};

/// Exactly 64 hexadecimal digits, either case. Errors: Syntax.
Result<Digest> parse_digest(std::string_view hex);

/// Incremental SHA-256. Movable; one thread at a time.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void update(std::span<const std::byte> bytes);
  void update(std::string_view text);
  /// The digest of everything so far; more may follow.
  Digest digest() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

Digest sha256(std::span<const std::byte> bytes);
Digest sha256(std::string_view text);

/// CRC-32 (IEEE 802.3, as zlib computes it) of `bytes`; pass the previous value to continue.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t previous = 0);

}  // namespace dripline
