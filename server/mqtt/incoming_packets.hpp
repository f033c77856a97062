#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/base/result.hpp"

/// What a broker sends, MQTT 5 and 3.1.1. Pure. Nothing here trusts a byte: every length is
/// compared with what is there, and memory is taken for bytes that have come only.
namespace dripline::mqtt {

enum class PacketType : std::uint8_t {
  Connect = 1,
  Connack = 2,
  Publish = 3,
  Puback = 4,
  Pubrec = 5,
  Pubrel = 6,
  Pubcomp = 7,
  Subscribe = 8,
  Suback = 9,
  Pingreq = 12,
  Pingresp = 13,
  Disconnect = 14,
};

struct Packet {
  PacketType type{};  ///< perhaps none of the enumerators
  std::uint8_t flags = 0;
  std::string_view body;
};

/// Cuts packets out of bytes in pieces of any size.
class PacketReader {
 public:
  static constexpr std::size_t kMaxPacket = 256 * 1024;  ///< of a packet without its header

  void add(std::string_view bytes) {
    waiting_.erase(0, std::exchange(taken_, 0));
    waiting_.append(bytes);
  }
  /// The next one, whole, valid until `add`; nullopt: more bytes are needed. Errors: Syntax,
  /// LimitExceeded, by the header alone; then nothing more can be read.
  Result<std::optional<Packet>> next();
  /// Bytes that are held.
  std::size_t size() const { return waiting_.size(); }

 private:
  std::string waiting_;
  std::size_t taken_ = 0;  ///< at its beginning
};

/// How a broker takes a connection.
struct Connack {
  std::uint8_t reason = 0;  ///< 0: accepted
  std::uint16_t receive_maximum = 65535;
  std::uint8_t max_qos = 2;
  bool has_retain = true;
  std::uint32_t max_packet = 0xffffffff;
  std::optional<std::uint16_t> keep_alive;  ///< seconds; 0: it does not look
};
/// PUBACK, PUBREC, PUBREL and PUBCOMP.
struct Answer {
  std::uint16_t packet = 0;
  std::uint8_t reason = 0;  ///< from kFirstRefusal on: refused
};
inline constexpr std::uint8_t kFirstRefusal = 0x80;
struct Publication {
  std::string_view topic, payload;
  std::uint16_t packet = 0;  ///< with QoS 1
  int qos = 0;
  bool is_retained = false;
};

/// All: the whole body is read. Errors: Syntax.
Result<Connack> read_connack(const Packet& packet, bool is_version_5);
Result<Answer> read_answer(const Packet& packet, bool is_version_5);
Result<Publication> read_publication(const Packet& packet, bool is_version_5);
/// The number of the SUBSCRIBE for one topic that it answers, and how.
Result<Answer> read_suback(const Packet& packet, bool is_version_5);
/// The reason; of MQTT 5 alone.
Result<std::uint8_t> read_disconnect(const Packet& packet);

/// What the number means, of MQTT 5.
std::string reason_text(std::uint8_t reason);
/// ... and of a refused connection, with 3.1.1.
std::string refusal_text_311(std::uint8_t reason);

}  // namespace dripline::mqtt
