#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/base/result.hpp"
#include "server/mqtt/broker_link.hpp"
#include "server/mqtt/incoming_packets.hpp"

/// What is sent to a broker, MQTT 5 and 3.1.1, as bytes. Pure.
namespace dripline::mqtt {

struct Introduction {
  std::string client_id;
  std::string user, password;    ///< empty user: neither
  std::uint16_t keep_alive = 0;  ///< seconds
  bool is_version_5 = true;
};

/// CONNECT without a session. Errors: LimitExceeded (a text is longer than 65535 bytes).
Result<std::string> connect_packet(const Introduction& introduction, const Message& will);
/// `packet` is 0 with QoS 0. The topic has at most 65535 bytes.
std::string publish_packet(const Message& message, std::uint16_t packet, bool is_version_5);
std::size_t publish_size(const Message& message, bool is_version_5);
/// PUBACK and PUBREL.
std::string answer_packet(PacketType type, std::uint16_t packet);
/// With QoS 1. The topic has at most 65535 bytes.
std::string subscribe_packet(const std::string& topic, std::uint16_t packet, bool is_version_5);
/// PINGREQ and DISCONNECT.
std::string empty_packet(PacketType type);

inline constexpr std::size_t kMaxFieldSize = 65535;

}  // namespace dripline::mqtt
