#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace dripline {

/// CRC-32 (IEEE 802.3, as zlib computes it) of `bytes`; pass the previous value to continue.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t previous = 0);

}  // namespace dripline
