// A list file of the cache, as it is and with a checksum that fits. Properties: what was read has
// the chunks of its size, is written alike, and is of no other content.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "storage/cache/list_file.hpp"
#include "storage/programs/chunk_codec.hpp"

namespace {

using namespace dripline;

const Digest kContent = sha256("a content");

void look_at(std::span<const std::byte> bytes) {
  const auto read = cache::read_list(kContent, bytes);
  if (!read) return;
  const bool has_rest = read->size % storage::kChunkBytes != 0;
  if (read->size / storage::kChunkBytes + (has_rest ? 1 : 0) != read->chunks.size()) std::abort();
  if (!std::ranges::equal(cache::to_bytes(kContent, *read), bytes)) std::abort();
  if (cache::read_list(sha256("another"), bytes)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto given = std::as_bytes(std::span(data, size));
  look_at(given);
  // The input after a head that fits, so that what follows it is reached.
  auto bytes = cache::to_bytes(kContent, {});
  bytes.resize(bytes.size() - Digest::kSize - sizeof(std::uint64_t));
  bytes.insert(bytes.end(), given.begin(), given.end());
  const Digest checksum = sha256(bytes);
  bytes.insert(bytes.end(), checksum.bytes.begin(), checksum.bytes.end());
  look_at(bytes);
  return 0;
}
