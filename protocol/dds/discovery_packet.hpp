#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace dripline::dds {

/// What a participant announces of itself, as far as a server that only listens needs it.
struct ParticipantAnnouncement {
  using Prefix = std::array<std::byte, 12>;
  Prefix prefix{};           ///< of its GUID: another one with each start of its process
  std::uint32_t domain = 0;  ///< the number on the network
  std::string tag;           ///< NetworkOptions::tag
  bool operator==(const ParticipantAnnouncement&) const = default;
};

/// Of a datagram as it arrived. nullopt: it is not an announcement (other traffic, the end of a
/// participant, or not RTPS 2). Whoever reaches the port can send one: it proves nothing. Pure.
/// Sources: DDSI-RTPS 2.3, 8.3.3 and 9.4 (messages), 9.6.2 (parameters); the domain and its tag,
/// Cyclone DDS 0.10 sends both.
std::optional<ParticipantAnnouncement> read_announcement(std::span<const std::byte> datagram);

}  // namespace dripline::dds
