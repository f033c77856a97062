#include "storage/impl/chunk_codec.hpp"

#include <zstd.h>
#include <algorithm>

#include "protocol/base/invariant.hpp"

namespace dripline::storage {
namespace {

// NC text shrinks 3 to 4 times at level 1; higher levels gain little and cost much.
constexpr int kCompressionLevel = 1;

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};
using Context = std::unique_ptr<ZSTD_CCtx, FreeContext>;

EncodedChunk encode(ZSTD_CCtx* context, std::span<const std::byte> plain) {
  EncodedChunk chunk{sha256(plain), plain.size(), {}};
  std::vector<std::byte> frame(ZSTD_compressBound(plain.size()));
  const std::size_t written = ZSTD_compressCCtx(context, frame.data(), frame.size(), plain.data(),
                                                plain.size(), kCompressionLevel);
  invariant(!ZSTD_isError(written), "zstd compresses into a buffer of its own bound");
  chunk.data.assign(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(written));
  return chunk;
}

}  // namespace

std::vector<EncodedChunk> encode_chunks(std::span<const std::byte> tail,
                                        std::span<const std::byte> bytes) {
  const Context context(ZSTD_createCCtx());
  invariant(context != nullptr, "memory for a zstd context");
  std::vector<EncodedChunk> chunks;
  if (!tail.empty()) {
    const std::size_t taken = std::min<std::size_t>(bytes.size(), kChunkBytes - tail.size());
    std::vector<std::byte> joined(tail.begin(), tail.end());
    joined.insert(joined.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
    chunks.push_back(encode(context.get(), joined));
    bytes = bytes.subspan(taken);
  }
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min<std::size_t>(bytes.size(), kChunkBytes));
    chunks.push_back(encode(context.get(), piece));
    bytes = bytes.subspan(piece.size());
  }
  return chunks;
}

Result<std::vector<std::byte>> decode_chunk(const Digest& digest, std::uint64_t size,
                                            std::span<const std::byte> data) {
  if (size > kChunkBytes) {
    return fail(Errc::Corrupt, "size {} is more than a chunk's {}", size, kChunkBytes);
  }
  std::vector<std::byte> plain(size);
  const std::size_t written = ZSTD_decompress(plain.data(), plain.size(), data.data(), data.size());
  if (ZSTD_isError(written)) {
    return fail(Errc::Corrupt, "not decompressible ({})", ZSTD_getErrorName(written));
  }
  if (written != size) return fail(Errc::Corrupt, "holds {} bytes instead of {}", written, size);
  if (const Digest found = sha256(plain); found != digest) {
    return fail(Errc::Corrupt, "SHA-256 of its bytes is {} instead of {}", found.hex(),
                digest.hex());
  }
  return plain;
}

}  // namespace dripline::storage
