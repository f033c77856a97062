#include "storage/cache/list_file.hpp"

#include <algorithm>
#include <string_view>

#include "storage/programs/chunk_codec.hpp"

namespace dripline::cache {
namespace {

constexpr std::string_view kMagic = "DNClist1";
constexpr std::size_t kNumber = 8;
constexpr std::size_t kHead = kMagic.size() + Digest::kSize + kNumber;
constexpr unsigned kBitsOfByte = 8;

void add(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

Digest digest_at(std::span<const std::byte> bytes, std::size_t at) {
  Digest digest;
  std::ranges::copy(bytes.subspan(at, Digest::kSize), digest.bytes.begin());
  return digest;
}

std::uint64_t number_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (const std::byte byte : bytes.subspan(at, kNumber))
    number = number << kBitsOfByte | std::to_integer<std::uint64_t>(byte);
  return number;
}

}  // namespace

std::vector<std::byte> to_bytes(const Digest& content, const storage::ContentList& list) {
  std::vector<std::byte> bytes;
  bytes.reserve(kHead + (list.chunks.size() + 1) * Digest::kSize);
  add(bytes, std::as_bytes(std::span(kMagic)));
  add(bytes, content.bytes);
  for (std::size_t i = 0; i < kNumber; ++i)
    bytes.push_back(static_cast<std::byte>(list.size >> (kBitsOfByte * (kNumber - 1 - i))));
  for (const Digest& chunk : list.chunks) add(bytes, chunk.bytes);
  add(bytes, sha256(bytes).bytes);
  return bytes;
}

std::optional<storage::ContentList> read_list(const Digest& content,
                                              std::span<const std::byte> bytes) {
  const std::size_t least = kHead + Digest::kSize;
  if (bytes.size() < least || (bytes.size() - least) % Digest::kSize != 0) return std::nullopt;
  const auto body = bytes.first(bytes.size() - Digest::kSize);
  const auto magic = std::as_bytes(std::span(kMagic));
  if (!std::ranges::equal(body.first(kMagic.size()), magic)) return std::nullopt;
  if (digest_at(body, kMagic.size()) != content) return std::nullopt;
  if (digest_at(bytes, body.size()) != sha256(body)) return std::nullopt;
  storage::ContentList list;
  list.size = number_at(body, kMagic.size() + Digest::kSize);
  const std::uint64_t chunks = (bytes.size() - least) / Digest::kSize;
  const bool has_rest = list.size % storage::kChunkBytes != 0;
  if (list.size / storage::kChunkBytes + (has_rest ? 1 : 0) != chunks) return std::nullopt;
  list.chunks.reserve(chunks);
  for (std::size_t at = kHead; at < body.size(); at += Digest::kSize)
    list.chunks.push_back(digest_at(body, at));
  return list;
}

}  // namespace dripline::cache
