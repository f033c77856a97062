#include "protocol/base/crc32.hpp"

#include <zlib.h>

namespace dripline {

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t previous) {
  return static_cast<std::uint32_t>(
      ::crc32_z(previous, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace dripline
