#include <array>

#include "server/mqtt/incoming_packets.hpp"

namespace dripline::mqtt {
namespace {

struct ReasonRow {
  std::uint8_t reason;
  const char* text;
};

/// MQTT 5, section 2.4: those that a broker can send to a client that publishes.
constexpr std::array kReasons{
    ReasonRow{0x00, "Disconnected by the broker"},
    ReasonRow{0x01, "unacceptable protocol version"},  // of a broker without MQTT 5
    ReasonRow{0x80, "Unspecified error"},
    ReasonRow{0x81, "Malformed packet"},
    ReasonRow{0x82, "Protocol error"},
    ReasonRow{0x83, "Implementation specific error"},
    ReasonRow{0x84, "Unsupported protocol version"},
    ReasonRow{0x85, "Client identifier not valid"},
    ReasonRow{0x86, "Bad user name or password"},
    ReasonRow{0x87, "Not authorized"},
    ReasonRow{0x88, "Server unavailable"},
    ReasonRow{0x89, "Server busy"},
    ReasonRow{0x8a, "Banned"},
    ReasonRow{0x8b, "Server shutting down"},
    ReasonRow{0x8c, "Bad authentication method"},
    ReasonRow{0x8d, "Keep alive timeout"},
    ReasonRow{0x8e, "Session taken over"},
    ReasonRow{0x8f, "Topic filter invalid"},
    ReasonRow{0x90, "Topic name invalid"},
    ReasonRow{0x91, "Packet identifier in use"},
    ReasonRow{0x92, "Packet identifier not found"},
    ReasonRow{0x93, "Receive maximum exceeded"},
    ReasonRow{0x94, "Topic alias invalid"},
    ReasonRow{0x95, "Packet too large"},
    ReasonRow{0x96, "Message rate too high"},
    ReasonRow{0x97, "Quota exceeded"},
    ReasonRow{0x98, "Administrative action"},
    ReasonRow{0x99, "Payload format invalid"},
    ReasonRow{0x9a, "Retain not supported"},
    ReasonRow{0x9b, "QoS not supported"},
    ReasonRow{0x9c, "Use another server"},
    ReasonRow{0x9d, "Server moved"},
    ReasonRow{0x9f, "Connection rate exceeded"},
    ReasonRow{0xa0, "Maximum connect time"},
};

/// MQTT 3.1.1, section 3.2.2.3.
constexpr std::array<const char*, 6> kRefusals311{
    "accepted",           "unacceptable protocol version", "identifier rejected",
    "broker unavailable", "bad user name or password",     "not authorized"};

}  // namespace

std::string reason_text(std::uint8_t reason) {
  for (const auto& row : kReasons) {
    if (row.reason == reason) return row.text;
  }
  return fmt::format("reason {}", reason);
}

std::string refusal_text_311(std::uint8_t reason) {
  return reason < kRefusals311.size() ? kRefusals311.at(reason) : reason_text(reason);
}

}  // namespace dripline::mqtt
