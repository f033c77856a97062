#include "protocol/dds/discovery_packet.hpp"

#include <algorithm>

namespace dripline::dds {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kHeaderSize = 20, kSubmessageHeaderSize = 4;
constexpr std::size_t kPrefixAt = 8;
constexpr std::uint8_t kMajorVersion = 2;
constexpr std::uint8_t kData = 0x15, kInfoTimestamp = 0x09, kPadding = 0x01;  ///< submessages
constexpr std::uint8_t kLittleEndian = 1, kHasInlineQos = 2, kHasData = 4;    ///< their flags
constexpr std::uint32_t kAnnouncer = 0x000100C2;        ///< the built-in writer of participants
constexpr std::uint32_t kParticipant = 0x000001C1;      ///< the entity that is announced
constexpr std::uint16_t kListBig = 2, kListLittle = 3;  ///< encodings of a list of parameters
constexpr std::uint16_t kEnd = 1, kDomain = 0x000F, kGuid = 0x0050, kTag = 0x4014;
constexpr std::size_t kMaxTag = 256;  ///< NetworkOptions allows half of it

/// Of a span that is read from its begin; a read beyond its end makes it invalid, and is 0.
class Cursor {
 public:
  Cursor(Bytes bytes, bool is_little) : bytes_(bytes), is_little_(is_little) {}
  bool is_valid() const { return is_valid_; }
  Bytes rest() const { return bytes_; }
  Bytes take(std::size_t size) {
    if (size > bytes_.size()) {
      is_valid_ = false;
      size = bytes_.size();
    }
    const Bytes taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  std::uint32_t number(std::size_t size) {
    const Bytes taken = take(size);
    std::uint32_t value = 0;
    for (std::size_t i = 0; is_valid_ && i < size; ++i) {
      const auto byte = taken[is_little_ ? size - 1 - i : i];
      value = value << 8U | std::to_integer<std::uint32_t>(byte);
    }
    return value;
  }
  std::uint16_t half() { return static_cast<std::uint16_t>(number(2)); }

 private:
  Bytes bytes_;
  bool is_little_;
  bool is_valid_ = true;
};

std::uint32_t entity(Bytes bytes) {
  return Cursor(bytes, false).number(4);
}

/// `take(id, value)` of each parameter; false: the list has no end.
template <class Take>
bool each_parameter(Cursor& cursor, Take take) {
  while (cursor.is_valid() && !cursor.rest().empty()) {
    const std::uint16_t id = cursor.half(), size = cursor.half();
    if (!cursor.is_valid()) return false;
    if (id == kEnd) return true;
    const Bytes value = cursor.take(size);
    if (cursor.is_valid()) take(id, value);
  }
  return false;
}

std::optional<std::string> text(Bytes value, bool is_little) {
  Cursor cursor(value, is_little);
  const std::uint32_t size = cursor.number(4);
  if (size == 0 || size > kMaxTag) return std::nullopt;
  const Bytes characters = cursor.take(size);
  if (!cursor.is_valid() || characters.back() != std::byte{0}) return std::nullopt;
  std::string result;
  for (const std::byte byte : characters.first(size - 1))
    result.push_back(std::to_integer<char>(byte));
  return result;
}

/// The content of a sample: an encoding, then a list of parameters.
std::optional<ParticipantAnnouncement> read_sample(Bytes sample,
                                                   const ParticipantAnnouncement::Prefix& prefix) {
  Cursor head(sample, false);
  const std::uint16_t encoding = head.half();
  if (encoding != kListBig && encoding != kListLittle) return std::nullopt;
  const bool is_little = encoding == kListLittle;
  Cursor list(sample.subspan(std::min<std::size_t>(sample.size(), 4)), is_little);
  ParticipantAnnouncement result{.prefix = prefix, .domain = 0, .tag = {}};
  bool is_named = false, is_sound = true, has_domain = false;
  const bool has_end = each_parameter(list, [&](std::uint16_t id, Bytes value) {
    if (id == kGuid) {
      is_named = value.size() == prefix.size() + 4 &&
                 std::equal(prefix.begin(), prefix.end(), value.begin()) &&
                 entity(value.subspan(prefix.size())) == kParticipant;
    } else if (id == kDomain && value.size() == 4) {
      result.domain = Cursor(value, is_little).number(4);
      has_domain = true;
    } else if (id == kTag) {
      auto tag = text(value, is_little);
      is_sound = is_sound && tag;
      if (tag) result.tag = *std::move(tag);
    }
  });
  if (!has_end || !is_named || !is_sound || !has_domain) return std::nullopt;
  return result;
}

std::optional<ParticipantAnnouncement> read_data(Bytes body, std::uint8_t flags,
                                                 const ParticipantAnnouncement::Prefix& prefix) {
  const bool is_little = (flags & kLittleEndian) != 0;
  Cursor cursor(body, is_little);
  constexpr std::size_t kOfFlags = 2, kOfEntity = 4, kOfNumber = 8;
  cursor.take(kOfFlags);
  const std::size_t to_qos = cursor.half();
  cursor.take(kOfEntity);  // the reader: any
  const std::uint32_t writer = entity(cursor.take(kOfEntity));
  cursor.take(kOfNumber);
  constexpr std::size_t kFixed = kOfEntity + kOfEntity + kOfNumber;
  if (!cursor.is_valid() || writer != kAnnouncer || to_qos < kFixed) return std::nullopt;
  cursor.take(to_qos - kFixed);
  if ((flags & kHasInlineQos) != 0 && !each_parameter(cursor, [](std::uint16_t, Bytes) {}))
    return std::nullopt;
  if (!cursor.is_valid() || (flags & kHasData) == 0) return std::nullopt;
  return read_sample(cursor.rest(), prefix);
}

}  // namespace

std::optional<ParticipantAnnouncement> read_announcement(Bytes datagram) {
  constexpr std::array kMagic{std::byte{'R'}, std::byte{'T'}, std::byte{'P'}, std::byte{'S'}};
  if (datagram.size() < kHeaderSize ||
      !std::equal(kMagic.begin(), kMagic.end(), datagram.begin()) ||
      std::to_integer<std::uint8_t>(datagram[kMagic.size()]) != kMajorVersion)
    return std::nullopt;
  ParticipantAnnouncement::Prefix prefix{};
  std::copy_n(datagram.begin() + kPrefixAt, prefix.size(), prefix.begin());
  Bytes rest = datagram.subspan(kHeaderSize);
  while (rest.size() >= kSubmessageHeaderSize) {
    const auto id = std::to_integer<std::uint8_t>(rest[0]);
    const auto flags = std::to_integer<std::uint8_t>(rest[1]);
    std::size_t size = Cursor(rest.subspan(2), (flags & kLittleEndian) != 0).half();
    rest = rest.subspan(kSubmessageHeaderSize);
    const bool is_last = size == 0 && id != kInfoTimestamp && id != kPadding;
    if (is_last) size = rest.size();
    if (size > rest.size()) return std::nullopt;
    if (id == kData) {
      if (auto read = read_data(rest.first(size), flags, prefix)) return read;
    }
    rest = rest.subspan(size);
  }
  return std::nullopt;
}

}  // namespace dripline::dds
