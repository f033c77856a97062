#include "server/mqtt/incoming_packets.hpp"

#include <array>

namespace dripline::mqtt {
namespace {

/// Takes fields from the front of a body. After one that is not whole all are empty, and `is_good`
/// is false.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : left_(bytes) {}

  std::string_view bytes(std::size_t size) {
    if (!is_good_ || left_.size() < size) return spoil();
    const auto taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }
  std::uint32_t number(std::size_t size) {
    std::uint32_t value = 0;
    for (const char byte : bytes(size)) value = value << 8U | static_cast<unsigned char>(byte);
    return value;
  }
  std::string_view text() { return bytes(number(2)); }
  /// At most four bytes, seven bits in each.
  std::uint32_t variable() {
    constexpr unsigned kMost = 28;
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < kMost; shift += 7) {
      const std::uint32_t byte = number(1);
      value |= (byte & 0x7fU) << shift;
      if ((byte & 0x80U) == 0) return value;
    }
    spoil();
    return 0;
  }
  std::string_view rest() { return bytes(left_.size()); }
  bool is_empty() const { return left_.empty(); }
  bool is_good() const { return is_good_; }

 private:
  std::string_view spoil() {
    is_good_ = false;
    left_ = {};
    return {};
  }

  std::string_view left_;
  bool is_good_ = true;
};

enum class Form : std::uint8_t { None, Byte, Two, Four, Variable, Text, Pair };

struct PropertyRow {
  std::uint8_t id;
  Form form;
};

/// MQTT 5, section 2.2.2.2.
constexpr std::array kProperties{
    PropertyRow{0x01, Form::Byte},      // payload format indicator
    PropertyRow{0x02, Form::Four},      // message expiry interval
    PropertyRow{0x03, Form::Text},      // content type
    PropertyRow{0x08, Form::Text},      // response topic
    PropertyRow{0x09, Form::Text},      // correlation data
    PropertyRow{0x0b, Form::Variable},  // subscription identifier
    PropertyRow{0x11, Form::Four},      // session expiry interval
    PropertyRow{0x12, Form::Text},      // assigned client identifier
    PropertyRow{0x13, Form::Two},       // server keep alive
    PropertyRow{0x15, Form::Text},      // authentication method
    PropertyRow{0x16, Form::Text},      // authentication data
    PropertyRow{0x17, Form::Byte},      // request problem information
    PropertyRow{0x18, Form::Four},      // will delay interval
    PropertyRow{0x19, Form::Byte},      // request response information
    PropertyRow{0x1a, Form::Text},      // response information
    PropertyRow{0x1c, Form::Text},      // server reference
    PropertyRow{0x1f, Form::Text},      // reason string
    PropertyRow{0x21, Form::Two},       // receive maximum
    PropertyRow{0x22, Form::Two},       // topic alias maximum
    PropertyRow{0x23, Form::Two},       // topic alias
    PropertyRow{0x24, Form::Byte},      // maximum QoS
    PropertyRow{0x25, Form::Byte},      // retain available
    PropertyRow{0x26, Form::Pair},      // user property
    PropertyRow{0x27, Form::Four},      // maximum packet size
    PropertyRow{0x28, Form::Byte},      // wildcard subscription available
    PropertyRow{0x29, Form::Byte},      // subscription identifier available
    PropertyRow{0x2a, Form::Byte},      // shared subscription available
};

enum PropertyId : std::uint8_t {
  kServerKeepAlive = 0x13,
  kReceiveMaximum = 0x21,
  kTopicAlias = 0x23,
  kMaximumQos = 0x24,
  kRetainAvailable = 0x25,
  kMaximumPacketSize = 0x27,
};

Form form_of(std::uint32_t id) {
  for (const auto& row : kProperties) {
    if (row.id == id) return row.form;
  }
  return Form::None;
}

std::uint32_t take_value(Fields& fields, Form form) {
  switch (form) {
    case Form::Byte:
      return fields.number(1);
    case Form::Two:
      return fields.number(2);
    case Form::Four:
      return fields.number(4);
    case Form::Variable:
      return fields.variable();
    case Form::Pair:
      fields.text();
      [[fallthrough]];
    case Form::Text:
      fields.text();
      [[fallthrough]];
    case Form::None:
      return 0;
  }
  return 0;
}

tl::unexpected<Error> malformed(std::string_view packet) {
  return fail(Errc::Syntax, "malformed {}", packet);
}

/// Calls `take(id, value)` for each; what has no number has the value 0.
template <class Take>
Result<void> read_properties(Fields& fields, std::string_view packet, Take take) {
  Fields properties(fields.bytes(fields.variable()));
  if (!fields.is_good()) return malformed(packet);
  while (!properties.is_empty()) {
    const std::uint32_t id = properties.variable();
    const Form form = form_of(id);
    if (!properties.is_good()) return malformed(packet);
    if (form == Form::None)
      return fail(Errc::Syntax, "{} with property {}, which MQTT 5 does not define", packet, id);
    const std::uint32_t value = take_value(properties, form);
    if (!properties.is_good()) return malformed(packet);
    take(id, value);
  }
  return {};
}

constexpr auto kPassOver = [](std::uint32_t, std::uint32_t) {};

void take_limit(Connack& connack, std::uint32_t id, std::uint32_t value) {
  if (id == kServerKeepAlive) connack.keep_alive = static_cast<std::uint16_t>(value);
  if (id == kReceiveMaximum) connack.receive_maximum = static_cast<std::uint16_t>(value);
  if (id == kMaximumQos) connack.max_qos = static_cast<std::uint8_t>(value);
  if (id == kRetainAvailable) connack.has_retain = value != 0;
  if (id == kMaximumPacketSize) connack.max_packet = value;
}

}  // namespace

Result<std::optional<Packet>> PacketReader::next() {
  constexpr std::size_t kHeader = 5;
  const auto left = std::string_view(waiting_).substr(taken_);
  const auto header = left.substr(0, kHeader);
  std::size_t size = 0;
  for (std::size_t i = 1; i < header.size(); ++i) {
    const auto byte = static_cast<unsigned char>(header[i]);
    size |= static_cast<std::size_t>(byte & 0x7fU) << 7 * (i - 1);
    if ((byte & 0x80U) != 0) continue;
    if (size > kMaxPacket)
      return fail(Errc::LimitExceeded, "a packet of {} bytes: at most {}", size, kMaxPacket);
    const std::size_t begin = i + 1;
    if (left.size() < begin + size) return std::optional<Packet>();
    taken_ += begin + size;
    const auto first = static_cast<unsigned char>(header[0]);
    return Packet{static_cast<PacketType>(first >> 4U), static_cast<std::uint8_t>(first & 0x0fU),
                  left.substr(begin, size)};
  }
  if (header.size() == kHeader) return malformed("header of a packet");
  return std::optional<Packet>();
}

Result<Connack> read_connack(const Packet& packet, bool is_version_5) {
  Fields fields(packet.body);
  Connack connack;
  fields.number(1);  // whether it has a session of ours: it may not
  connack.reason = static_cast<std::uint8_t>(fields.number(1));
  if (!fields.is_good() || packet.flags != 0) return malformed("CONNACK");
  // A broker without MQTT 5 refuses without properties.
  const bool has_properties = is_version_5 && !(connack.reason != 0 && fields.is_empty());
  if (has_properties) {
    auto read = read_properties(fields, "CONNACK", [&](std::uint32_t id, std::uint32_t value) {
      take_limit(connack, id, value);
    });
    if (!read) return fail(read.error());
  }
  const bool is_usable =
      connack.receive_maximum != 0 && connack.max_packet != 0 && connack.max_qos <= 2;
  if (!fields.is_empty() || !is_usable) return malformed("CONNACK");
  return connack;
}

Result<Answer> read_answer(const Packet& packet, bool is_version_5) {
  constexpr std::string_view kName = "acknowledgment";
  Fields fields(packet.body);
  Answer answer;
  answer.packet = static_cast<std::uint16_t>(fields.number(2));
  if (is_version_5 && !fields.is_empty())
    answer.reason = static_cast<std::uint8_t>(fields.number(1));
  if (is_version_5 && !fields.is_empty()) {
    if (auto read = read_properties(fields, kName, kPassOver); !read) return fail(read.error());
  }
  if (!fields.is_good() || !fields.is_empty() || packet.flags != 0) return malformed(kName);
  return answer;
}

Result<Publication> read_publication(const Packet& packet, bool is_version_5) {
  constexpr std::string_view kName = "PUBLISH";
  Fields fields(packet.body);
  Publication publication;
  publication.is_retained = (packet.flags & 1U) != 0;
  publication.qos = packet.flags >> 1U & 3U;
  publication.topic = fields.text();
  if (publication.qos != 0) publication.packet = static_cast<std::uint16_t>(fields.number(2));
  if (is_version_5) {
    bool has_alias = false;
    auto read = read_properties(fields, kName, [&](std::uint32_t id, std::uint32_t) {
      has_alias = has_alias || id == kTopicAlias;
    });
    if (!read) return fail(read.error());
    if (has_alias) return fail(Errc::Syntax, "PUBLISH with a topic alias, which is not offered");
  }
  const bool is_whole = fields.is_good() && !publication.topic.empty();
  const bool has_number = publication.qos == 0 || publication.packet != 0;
  if (!is_whole || !has_number) return malformed(kName);
  if (publication.qos > 1)
    return fail(Errc::Syntax, "PUBLISH with QoS {}: at most 1 is asked for", publication.qos);
  publication.payload = fields.rest();
  return publication;
}

Result<Answer> read_suback(const Packet& packet, bool is_version_5) {
  Fields fields(packet.body);
  Answer answer;
  answer.packet = static_cast<std::uint16_t>(fields.number(2));
  if (is_version_5) {
    if (auto read = read_properties(fields, "SUBACK", kPassOver); !read) return fail(read.error());
  }
  answer.reason = static_cast<std::uint8_t>(fields.number(1));
  if (!fields.is_good() || !fields.is_empty() || packet.flags != 0) return malformed("SUBACK");
  return answer;
}

Result<std::uint8_t> read_disconnect(const Packet& packet) {
  Fields fields(packet.body);
  std::uint8_t reason = 0;
  if (!fields.is_empty()) reason = static_cast<std::uint8_t>(fields.number(1));
  if (!fields.is_empty()) {
    auto read = read_properties(fields, "DISCONNECT", kPassOver);
    if (!read) return fail(read.error());
  }
  if (!fields.is_good() || !fields.is_empty() || packet.flags != 0) return malformed("DISCONNECT");
  return reason;
}

}  // namespace dripline::mqtt
