#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "protocol/base/digest.hpp"
#include "protocol/dds/impl/topic.hpp"
#include "protocol/dds/members.hpp"

namespace dripline::dds::fuzz {

/// Fills generated structs from fuzzed bytes, as Cyclone's CDR reader would: texts end within their
/// arrays, sequences keep their bounds, everything else is arbitrary. Missing bytes read as zero.
/// The format is that of the corpus: numbers little-endian, texts and sequences after a 16-bit
/// length.
class SampleReader {
 public:
  explicit SampleReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class Message>
  void read(SampleOf<Message>& sample) {
    fill_members<Message>(sample);
    if constexpr (std::same_as<Message, Announce>) one(sample.heard);
  }

 private:
  /// Fills the members that the message's list names, and the flags and checksums beside them.
  template <class Message, class Sample>
  void fill_members(Sample& sample) {
    const Message message{};
    members([&](const auto& member, const auto&... rules) { fill(sample, member, rules...); },
            message);
  }
  void fill(auto& sample, const auto& member, const auto&...) { one(member.field(sample)); }
  template <class T, class Field, class Flag>
  void fill(auto& sample, const Member<const std::optional<T>, Field>& member,
            const PresentIf<Flag>& present, const auto&...) {
    one(present.flag(sample));
    if constexpr (requires { one(member.field(sample)); }) {
      one(member.field(sample));
    } else {
      fill_members<T>(member.field(sample));
    }
  }
  template <class T, class Field>
  void fill(auto&, const Member<T, Field>&, SetupText) {}  // the corpus holds none
  template <class T, class Field, class Crc>
  void fill(auto& sample, const Member<T, Field>& member, const CheckedBy<Crc>& checked_by) {
    const auto bytes = take(std::min<std::size_t>(number<std::uint16_t>(), kMaxBlockBytes));
    block_.assign(bytes.begin(), bytes.end());
    auto& field = member.field(sample);
    field._maximum = field._length = static_cast<std::uint32_t>(block_.size());
    field._buffer = block_.data();
    // A fuzzer does not find checksums: zero is replaced by the right one.
    auto& crc = checked_by.crc(sample);
    one(crc);
    if (crc == 0) crc = crc32(std::as_bytes(std::span(block_)));
  }

  std::span<const std::uint8_t> take(std::size_t wanted) {
    const auto result = bytes_.first(std::min(wanted, bytes_.size()));
    bytes_ = bytes_.subspan(result.size());
    return result;
  }
  template <class T>
  T number() {
    T value{};
    const auto bytes = take(sizeof value);
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void one(T& value) { value = number<T>(); }
  void one(dds_sequence_double& field) {
    positions_.resize(std::min<std::size_t>(number<std::uint16_t>(), 9));
    for (double& value : positions_) one(value);
    field._maximum = field._length = static_cast<std::uint32_t>(positions_.size());
    field._buffer = positions_.data();
  }
  void one(bool& value) { value = (number<std::uint8_t>() & 1) != 0; }
  template <std::size_t N>
  void one(char (&field)[N]) {
    const auto bytes = take(std::min<std::size_t>(number<std::uint16_t>(), N - 1));
    if (!bytes.empty()) std::memcpy(field, bytes.data(), bytes.size());
    field[bytes.size()] = '\0';
  }
  template <std::size_t N>
  void one(double (&field)[N]) {
    for (double& value : field) one(value);
  }

  std::span<const std::uint8_t> bytes_;
  std::vector<double> positions_;
  std::vector<std::uint8_t> block_;
};

}  // namespace dripline::dds::fuzz
