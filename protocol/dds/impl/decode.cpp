#include "protocol/dds/impl/decode.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "protocol/base/digest.hpp"
#include "protocol/dds/impl/check.hpp"
#include "protocol/dds/members.hpp"

namespace dripline::dds {
namespace {

/// Reads the members of one sample into its message; the first that is wrong is kept as the error.
template <class Sample>
class SampleReader {
 public:
  SampleReader(const Sample& sample, std::optional<Error>& error)
      : sample_(sample), error_(error) {}

  template <class Member, class... Rules>
  void operator()(const Member& member, const Rules&... rules) {
    get(member.value, member.field(sample_), member.wire_name, rules...);
  }

 private:
  template <std::size_t N>
  void get(std::string& text, const char (&field)[N], std::string_view name, const auto&...) {
    const char* end = std::find(field, field + N, '\0');
    text.assign(field, end);
    if (end == field + N || !is_sendable_text(text)) reject(name, "is not UTF-8 text");
  }
  void get(std::string& text, const dds_sequence_octet& field, std::string_view name, SetupText) {
    const auto bytes = as_bytes(field);
    if (bytes.size() > kMaxCommandSetup) return reject(name, "is too long");
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  template <class Crc>
  void get(std::vector<std::byte>& value, const dds_sequence_octet& field, std::string_view name,
           const CheckedBy<Crc>& checked_by) {
    const auto bytes = as_bytes(field);
    if (bytes.size() > kMaxBlockBytes) return reject(name, "are too many");
    if (crc32(bytes) != checked_by.crc(sample_)) {
      return reject(name, "do not match their CRC", Errc::Corrupt);
    }
    value.assign(bytes.begin(), bytes.end());
  }
  template <std::size_t N>
  void get(std::array<double, N>& numbers, const dds_sequence_double& field,
           std::string_view name) {
    if (field._length != N) return reject(name, fmt::format("does not have {} axes", N));
    std::copy_n(field._buffer, N, numbers.begin());
  }
  template <std::size_t N>
  void get(std::array<double, N>& numbers, const double (&field)[N], std::string_view) {
    std::copy_n(field, N, numbers.begin());
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void get(T& number, const T& field, std::string_view, const auto&...) { number = field; }
  template <Enumeration Enum>
  void get(Enum& value, std::uint8_t field, std::string_view name) {
    if (field >= words_of(value).size()) {
      return reject(name, fmt::format("has no meaning for {}", field));
    }
    value = static_cast<Enum>(field);
  }
  void get(UtcTime& time, std::int64_t field, std::string_view, const auto&...) {
    time = UtcTime{std::chrono::microseconds{field}};
  }
  void get(std::chrono::microseconds& time, std::int64_t field, std::string_view, const auto&...) {
    time = std::chrono::microseconds{field};
  }
  template <class T>
  void get(std::optional<T>& number, const T& field, std::string_view, NoneIfNegative) {
    if (field >= 0) number = field;
  }
  void get(std::optional<UtcTime>& time, std::int64_t field, std::string_view, ExpiryTime) {
    if (field != 0) time = UtcTime{std::chrono::microseconds{field}};
  }
  void get(std::optional<std::uint8_t>& axis, std::uint8_t field, std::string_view name,
           AxisNumber) {
    constexpr std::uint8_t kLastAxis = 9;
    if (field > kLastAxis) return reject(name, fmt::format("has no meaning for {}", field));
    if (field > 0) axis = static_cast<std::uint8_t>(field - 1);
  }
  template <class T, class Field, class Flag>
  void get(std::optional<T>& value, const Field& field, std::string_view name,
           const PresentIf<Flag>& present, const auto&...) {
    if (!present.flag(sample_)) return;
    value.emplace();
    if constexpr (requires { get(*value, field, name); }) {
      get(*value, field, name);
    } else {
      members(SampleReader<Field>(field, error_), *value);
    }
  }

  static std::span<const std::byte> as_bytes(const dds_sequence_octet& sequence) {
    return std::as_bytes(std::span(sequence._buffer, sequence._length));
  }
  void reject(std::string_view name, std::string_view what, Errc code = Errc::Syntax) {
    if (!error_) error_ = Error{code, fmt::format("{} {}", name, what)};
  }

  const Sample& sample_;
  std::optional<Error>& error_;
};

}  // namespace

template <class Sample>
Result<MessageOf<Sample>> decode(const Sample& sample) {
  MessageOf<Sample> message;
  std::optional<Error> error;
  members(SampleReader<Sample>(sample, error), message);
  if (error) return fail(*std::move(error));
  if (auto checked = check(message); !checked) return fail(checked.error());
  return message;
}

template Result<Announce> decode(const SampleOf<Announce>&);
template Result<Status> decode(const SampleOf<Status>&);
template Result<Record> decode(const SampleOf<Record>&);
template Result<RecordAck> decode(const SampleOf<RecordAck>&);
template Result<Command> decode(const SampleOf<Command>&);
template Result<CommandResult> decode(const SampleOf<CommandResult>&);
template Result<BlockRequest> decode(const SampleOf<BlockRequest>&);
template Result<BlockData> decode(const SampleOf<BlockData>&);
template Result<LineRequest> decode(const SampleOf<LineRequest>&);
template Result<LineData> decode(const SampleOf<LineData>&);

}  // namespace dripline::dds
