#include "server/mqtt/outgoing_packets.hpp"

namespace dripline::mqtt {
namespace {

/// The high byte first.
std::string number_field(std::uint64_t value, unsigned size) {
  std::string bytes;
  for (unsigned i = size; i > 0; --i) bytes += static_cast<char>(value >> 8 * (i - 1) & 0xffU);
  return bytes;
}
std::string text_field(const std::string& text) {
  return number_field(text.size(), 2) + text;
}
std::string length_field(std::size_t value) {
  std::string bytes;
  do {
    const std::size_t more = value >> 7U;
    bytes += static_cast<char>((value & 0x7fU) | (more > 0 ? 0x80U : 0U));
    value = more;
  } while (value > 0);
  return bytes;
}

std::string packet_of(PacketType type, unsigned flags, const std::string& body) {
  const auto first = static_cast<char>(static_cast<unsigned>(type) << 4U | flags);
  return first + length_field(body.size()) + body;
}

std::size_t body_size(const Message& message, bool is_version_5) {
  return 2 + message.topic.size() + (message.qos > 0 ? 2U : 0U) + (is_version_5 ? 1U : 0U) +
         message.payload.size();
}

}  // namespace

Result<std::string> connect_packet(const Introduction& introduction, const Message& will) {
  for (const auto* text : {&introduction.client_id, &introduction.user, &introduction.password,
                           &will.topic, &will.payload}) {
    if (text->size() > kMaxFieldSize)
      return fail(Errc::LimitExceeded, "mqtt: a text of {} bytes: at most {}", text->size(),
                  kMaxFieldSize);
  }
  constexpr char kVersion5 = 5, kVersion311 = 4;
  constexpr unsigned kClean = 0x02, kWill = 0x04, kRetained = 0x20;
  constexpr unsigned kUser = 0x80, kPassword = 0x40;
  const bool has_user = !introduction.user.empty();
  const bool has_password = has_user && !introduction.password.empty();
  const unsigned flags = kClean | kWill | static_cast<unsigned>(will.qos) << 3U |
                         (will.is_retained ? kRetained : 0U) | (has_user ? kUser : 0U) |
                         (has_password ? kPassword : 0U);
  std::string body = text_field("MQTT");
  body += introduction.is_version_5 ? kVersion5 : kVersion311;
  body += static_cast<char>(flags);
  body += number_field(introduction.keep_alive, 2);
  if (introduction.is_version_5) {
    const std::string size = "\x27" + number_field(PacketReader::kMaxPacket, 4);
    body += length_field(size.size()) + size;
  }
  body += text_field(introduction.client_id);
  if (introduction.is_version_5) body += length_field(0);  // no properties of the will
  body += text_field(will.topic) + text_field(will.payload);
  if (has_user) body += text_field(introduction.user);
  if (has_password) body += text_field(introduction.password);
  return packet_of(PacketType::Connect, 0, body);
}

std::string publish_packet(const Message& message, std::uint16_t packet, bool is_version_5) {
  const unsigned flags = static_cast<unsigned>(message.qos) << 1U | (message.is_retained ? 1U : 0U);
  std::string body = text_field(message.topic);
  if (message.qos > 0) body += number_field(packet, 2);
  if (is_version_5) body += length_field(0);
  body += message.payload;
  return packet_of(PacketType::Publish, flags, body);
}

std::size_t publish_size(const Message& message, bool is_version_5) {
  const std::size_t body = body_size(message, is_version_5);
  return 1 + length_field(body).size() + body;
}

std::string answer_packet(PacketType type, std::uint16_t packet) {
  return packet_of(type, type == PacketType::Pubrel ? 2 : 0, number_field(packet, 2));
}

std::string subscribe_packet(const std::string& topic, std::uint16_t packet, bool is_version_5) {
  constexpr char kQos = 1;
  std::string body = number_field(packet, 2);
  if (is_version_5) body += length_field(0);
  body += text_field(topic) + kQos;
  return packet_of(PacketType::Subscribe, 2, body);
}

std::string empty_packet(PacketType type) {
  return packet_of(type, 0, {});
}

}  // namespace dripline::mqtt
