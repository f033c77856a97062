#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/digest.hpp"

namespace dripline::storage {

/// Plain bytes of every chunk but a content's last. Part of the file format: the chunk of an offset
/// is found by division.
inline constexpr std::uint64_t kChunkBytes = 256 << 10;

/// A chunk as it is stored: one zstd frame, addressed by the SHA-256 of its plain bytes.
struct EncodedChunk {
  Digest digest;
  std::uint64_t size = 0;  ///< plain
  std::vector<std::byte> data;
};

/// Cuts `tail` + `bytes` into chunks (the last may be short) and encodes them.
std::vector<EncodedChunk> encode_chunks(std::span<const std::byte> tail,
                                        std::span<const std::byte> bytes);

/// The plain bytes, checked. Never allocates more than `size` and kChunkBytes allow, whatever the
/// stored bytes are. Errors: Corrupt (what does not fit; the caller adds which chunk).
Result<std::vector<std::byte>> decode_chunk(const Digest& digest, std::uint64_t size,
                                            std::span<const std::byte> data);

}  // namespace dripline::storage
