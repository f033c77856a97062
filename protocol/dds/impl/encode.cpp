#include "protocol/dds/impl/encode.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "protocol/base/digest.hpp"
#include "protocol/dds/impl/check.hpp"
#include "protocol/dds/members.hpp"

namespace dripline::dds {
namespace {

/// Writes the members of one message into its sample; the first text that does not fit is kept as
/// the error.
template <class Sample>
class SampleWriter {
 public:
  SampleWriter(Sample& sample, Result<void>& result) : sample_(sample), result_(result) {}

  template <class Member, class... Rules>
  void operator()(const Member& member, const Rules&... rules) {
    put(member.value, member.field(sample_), member.wire_name, rules...);
  }

 private:
  template <std::size_t N>
  void put(const std::string& text, char (&field)[N], std::string_view name, const auto&...) {
    if (text.size() >= N) {
      reject(Errc::LimitExceeded,
             fmt::format("{} has {} bytes, at most {}", name, text.size(), N - 1));
    } else if (!is_sendable_text(text)) {
      reject(Errc::Syntax, fmt::format("{} is not UTF-8", name));
    } else {
      copy(text, field);
    }
  }
  template <std::size_t N>
  void put(const std::string& text, char (&field)[N], std::string_view, FreeText) {
    copy(make_sendable(text, N - 1), field);
  }
  template <std::size_t N>
  void put(const std::string& text, char (&field)[N], std::string_view name, RecordText) {
    if (text.size() >= N) {
      reject(Errc::LimitExceeded,
             fmt::format("record {} has {} bytes, at most {}", name, text.size(), N - 1));
    } else {
      copy(make_sendable(text, N - 1), field);
    }
  }
  void put(const std::string& text, dds_sequence_octet& field, std::string_view, SetupText) {
    borrow(std::as_bytes(std::span(text)), field);
  }
  template <class Crc>
  void put(const std::vector<std::byte>& bytes, dds_sequence_octet& field, std::string_view,
           const CheckedBy<Crc>& checked_by) {
    borrow(bytes, field);
    checked_by.crc(sample_) = crc32(bytes);
  }
  template <std::size_t N>
  void put(const std::array<double, N>& numbers, dds_sequence_double& field, std::string_view) {
    field._maximum = field._length = static_cast<std::uint32_t>(N);
    field._buffer = const_cast<double*>(numbers.data());  // borrowed, read only
  }
  template <std::size_t N>
  void put(const std::array<double, N>& numbers, double (&field)[N], std::string_view) {
    std::copy(numbers.begin(), numbers.end(), field);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T number, T& field, std::string_view, const auto&...) { field = number; }
  void put(Enumeration auto value, std::uint8_t& field, std::string_view) {
    field = static_cast<std::uint8_t>(value);
  }
  void put(UtcTime time, std::int64_t& field, std::string_view, const auto&...) {
    field = time.time_since_epoch().count();
  }
  void put(std::chrono::microseconds time, std::int64_t& field, std::string_view, const auto&...) {
    field = time.count();
  }
  template <class T>
  void put(const std::optional<T>& number, T& field, std::string_view, NoneIfNegative) {
    field = number.value_or(T{-1});
  }
  void put(const std::optional<UtcTime>& time, std::int64_t& field, std::string_view, ExpiryTime) {
    field = time ? time->time_since_epoch().count() : 0;
  }
  void put(const std::optional<std::uint8_t>& axis, std::uint8_t& field, std::string_view,
           AxisNumber) {
    field = axis ? static_cast<std::uint8_t>(*axis + 1) : std::uint8_t{0};
  }
  template <class T, class Field, class Flag>
  void put(const std::optional<T>& value, Field& field, std::string_view name,
           const PresentIf<Flag>& present, const auto&...) {
    present.flag(sample_) = value.has_value();
    if (!value) return;
    if constexpr (requires { put(*value, field, name); }) {
      put(*value, field, name);
    } else {
      members(SampleWriter<Field>(field, result_), *value);
    }
  }

  static void borrow(std::span<const std::byte> bytes, dds_sequence_octet& field) {
    field._maximum = field._length = static_cast<std::uint32_t>(bytes.size());
    // Borrowed, read only.
    field._buffer = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(bytes.data()));
  }
  template <std::size_t N>
  static void copy(const std::string& text, char (&field)[N]) {
    std::memcpy(field, text.data(), text.size());
    field[text.size()] = '\0';
  }
  void reject(Errc code, std::string what) {
    if (result_) result_ = fail(Error{code, std::move(what)});
  }

  Sample& sample_;
  Result<void>& result_;
};

}  // namespace

template <class Message>
Result<void> encode(const Message& message, SampleOf<Message>& sample) {
  auto result = check(message);
  if (!result) return result;
  sample = {};
  members(SampleWriter<SampleOf<Message>>(sample, result), message);
  return result;
}

template Result<void> encode(const Announce&, SampleOf<Announce>&);
template Result<void> encode(const Status&, SampleOf<Status>&);
template Result<void> encode(const Record&, SampleOf<Record>&);
template Result<void> encode(const RecordAck&, SampleOf<RecordAck>&);
template Result<void> encode(const Command&, SampleOf<Command>&);
template Result<void> encode(const CommandResult&, SampleOf<CommandResult>&);
template Result<void> encode(const BlockRequest&, SampleOf<BlockRequest>&);
template Result<void> encode(const BlockData&, SampleOf<BlockData>&);
template Result<void> encode(const LineRequest&, SampleOf<LineRequest>&);
template Result<void> encode(const LineData&, SampleOf<LineData>&);

}  // namespace dripline::dds
