#include "storage/programs/chunk_codec.hpp"

#include <zstd.h>
#include <atomic>
#include <system_error>
#include <thread>

#include "protocol/base/invariant.hpp"

namespace dripline::storage {
namespace {

// NC text shrinks 3 to 4 times at level 1; higher levels gain little and cost much.
constexpr int kCompressionLevel = 1;
constexpr std::size_t kMaxThreads = 4;  // of one piece

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

/// Compression is most of the cost of a push (280 MB/s on a core, the rest is three times faster),
/// so a big piece is shared out.
std::vector<EncodedChunk> encode_all(const std::vector<std::span<const std::byte>>& plain) {
  std::vector<EncodedChunk> chunks(plain.size());
  std::atomic<std::size_t> next = 0;
  const auto encode_some = [&] {
    const Context context(ZSTD_createCCtx());
    invariant(context != nullptr, "memory for a zstd context");
    for (std::size_t i = next++; i < plain.size(); i = next++) {
      chunks[i] = encode(context.get(), plain[i]);
    }
  };
  std::vector<std::jthread> helpers;
  const std::size_t threads =
      std::min<std::size_t>({kMaxThreads, plain.size() / 2, std::thread::hardware_concurrency()});
  try {
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(encode_some);
  } catch (const std::system_error&) {
    // No thread to be had: then this one does it alone.
  }
  encode_some();
  helpers.clear();  // joins
  return chunks;
}

}  // namespace

std::vector<EncodedChunk> encode_chunks(std::span<const std::byte> tail,
                                        std::span<const std::byte> bytes) {
  std::vector<std::byte> joined;
  std::vector<std::span<const std::byte>> plain;
  if (!tail.empty()) {
    const std::size_t taken = std::min<std::size_t>(bytes.size(), kChunkBytes - tail.size());
    joined.assign(tail.begin(), tail.end());
    joined.insert(joined.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
    plain.push_back(joined);
    bytes = bytes.subspan(taken);
  }
  while (!bytes.empty()) {
    plain.push_back(bytes.first(std::min<std::size_t>(bytes.size(), kChunkBytes)));
    bytes = bytes.subspan(plain.back().size());
  }
  return encode_all(plain);
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
