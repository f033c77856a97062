#pragma once

#include <string>

#include "protocol/dds/discovery_packet.hpp"

namespace dripline::test_support {

/// The smallest datagram with this announcement, little-endian, independent of what reads it.
inline std::string announcement_bytes(const dds::ParticipantAnnouncement& announcement) {
  const auto number = [](std::size_t value, int size) {
    std::string bytes;
    for (int i = 0; i < size; ++i, value >>= 8) bytes.push_back(static_cast<char>(value & 0xFF));
    return bytes;
  };
  const std::string prefix(reinterpret_cast<const char*>(announcement.prefix.data()),
                           announcement.prefix.size());
  std::string tag = announcement.tag + '\0';
  const std::string counted =
      number(tag.size(), 4) + tag + std::string((4 - tag.size() % 4) % 4, '\0');
  std::string data = number(0, 2) + number(16, 2) + number(0, 4) + std::string("\0\1\0\xC2", 4) +
                     number(0, 4) + number(1, 4) + std::string("\0\3\0\0", 4);
  data += number(0x50, 2) + number(16, 2) + prefix + std::string("\0\0\1\xC1", 4);
  data += number(0x0F, 2) + number(4, 2) + number(announcement.domain, 4);
  data += number(0x4014, 2) + number(counted.size(), 2) + counted;
  data += number(1, 2) + number(0, 2);
  return "RTPS" + std::string("\2\1\1\x10", 4) + prefix + std::string("\x15\5", 2) +
         number(data.size(), 2) + data;
}

inline std::span<const std::byte> as_datagram(const std::string& bytes) {
  return std::as_bytes(std::span(bytes));
}

}  // namespace dripline::test_support
