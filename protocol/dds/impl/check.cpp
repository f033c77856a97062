#include "protocol/dds/impl/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "protocol/base/digest.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/utf8.hpp"
#include "protocol/dds/members.hpp"

namespace dripline::dds {

namespace {

/// Collects the verdicts on the members of one message; the first failure is kept.
class Verdict {
 public:
  explicit Verdict(std::string_view message) : message_(message) {}

  template <class Member, class... Rules>
  void operator()(const Member& member, const Rules&... rules) {
    name_ = member.wire_name;
    look_at(member.value);
    (follow(rules, member.value), ...);
  }
  Verdict& that(bool holds, std::string_view member, std::string_view otherwise) {
    if (!holds && result_) result_ = fail(Errc::Syntax, "{}: {} {}", message_, member, otherwise);
    return *this;
  }
  Result<void> result() const { return result_; }

 private:
  // What holds for every value of a type.
  void look_at(const auto&) {}
  void look_at(double number) { that(std::isfinite(number), name_, "is not finite"); }
  template <std::size_t N>
  void look_at(const std::array<double, N>& numbers) {
    for (const double number : numbers) look_at(number);
  }
  template <class T>
  void look_at(const std::optional<T>& value) {
    if (!value) return;
    if constexpr (requires { members(*this, *value); }) {
      members(*this, *value);
    } else {
      look_at(*value);
    }
  }

  void follow(const auto&, const auto&) {}
  void follow(MachineName, const std::string& name) { take(check_machine_name(name)); }
  void follow(ProgramName, const std::string& name) {
    if (!name.empty()) take(check_program_name(name));
  }
  void follow(Word, const std::string& text) {
    that(std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; }), name_,
         "is not a plain word");
  }
  void follow(Identifier, const std::string& text) {
    that(!text.empty(), name_, "is empty");
    follow(Word{}, text);
  }
  void follow(Sha256, const std::string& text) {
    that(text.empty() || parse_digest(text), name_, "is not a SHA-256");
  }
  void follow(SetupText, const std::string& text) {
    that(text.size() <= kMaxCommandSetup, name_, "is too long");
    that(is_sendable_text(text), name_, "is not UTF-8 text");
  }
  void follow(Epoch, std::uint64_t epoch) {
    that(epoch >= 1 && epoch <= INT64_MAX, name_, "is out of range");
  }
  void follow(Positive, std::uint64_t number) { that(number >= 1, name_, "is not positive"); }
  void follow(RequestLength, std::uint32_t length) {
    that(length >= 1 && length <= kMaxRequestBytes, name_, "is out of range");
  }
  void follow(ExpiryTime, const std::optional<UtcTime>& time) {
    constexpr std::int64_t kYear10000 = 253'402'300'800'000'000;
    const auto us = time ? time->time_since_epoch().count() : 1;
    that(us > 0 && us < kYear10000, name_, "is out of range");
  }
  void follow(AxisNumber, const std::optional<std::uint8_t>& axis) {
    that(!axis || *axis < std::tuple_size_v<decltype(Status::position)>, name_, "is no axis");
  }
  void follow(MainAxisSet, std::uint8_t axes) {
    constexpr std::uint8_t kBeyondZ = 0xF8;
    that((axes & kBeyondZ) == 0, name_, "names an axis beyond Z");
  }
  template <class Crc>
  void follow(const CheckedBy<Crc>&, const std::vector<std::byte>& bytes) {
    that(bytes.size() <= kMaxBlockBytes, name_, "are too many");
  }
  void take(const Result<void>& checked) {
    if (!checked) that(false, name_, checked.error().what);
  }

  std::string_view message_, name_;
  Result<void> result_;
};

template <class Message>
Verdict check_members(std::string_view name, const Message& message) {
  Verdict verdict(name);
  members(verdict, message);
  return verdict;
}

}  // namespace

Result<void> check(const Announce& m) {
  return check_members("announce", m).result();
}

Result<void> check(const Status& m) {
  return check_members("status", m).result();
}

Result<void> check(const Record& m) {
  return check_members("record", m).result();
}

Result<void> check(const RecordAck& m) {
  return check_members("record_ack", m).result();
}

Result<void> check(const Command& m) {
  Verdict verdict = check_members("command", m);
  if (m.action == CommandAction::Start) {
    verdict.that(!m.run.empty(), "run", "is empty")
        .that(!m.program.empty(), "program", "is empty")
        .that(!m.revision.empty(), "revision", "is empty");
  }
  return verdict.result();
}

Result<void> check(const CommandResult& m) {
  return check_members("command_result", m).result();
}

Result<void> check(const BlockRequest& m) {
  return check_members("block_request", m)
      .that(m.offset <= UINT64_MAX - m.length, "offset", "is out of range")
      .result();
}

Result<void> check(const BlockData& m) {
  Verdict verdict = check_members("block_data", m);
  if (m.status != BlockStatus::Ok) {
    return verdict.that(m.bytes.empty(), "bytes", "come with a failure").result();
  }
  const bool fits = m.offset <= m.total_bytes && m.bytes.size() <= m.total_bytes - m.offset;
  const bool reaches_end = fits && m.offset + m.bytes.size() == m.total_bytes;
  return verdict.that(fits, "bytes", "lie beyond the total")
      .that(!m.ends || reaches_end, "ends", "is set before the total")
      .result();
}

Result<void> check(const LineRequest& m) {
  return check_members("line_request", m).result();
}

Result<void> check(const LineData& m) {
  return check_members("line_data", m)
      .that(m.status == LineResult::Done || m.bytes.empty(), "bytes", "come with a failure")
      .result();
}

namespace {

constexpr std::string_view kEllipsis = "…";

/// Length of the first character of `text` in bytes; 0 when it cannot be sent.
std::size_t sendable_length(std::string_view text) {
  return text[0] == '\0' ? 0 : utf8_length(text);
}

}  // namespace

bool is_sendable_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = sendable_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string make_sendable(std::string_view text, std::size_t limit) {
  if (text.size() <= limit && is_sendable_text(text)) return std::string(text);
  std::string result;
  std::size_t fits = 0;  // the longest whole prefix that leaves room for the ellipsis
  while (!text.empty() && result.size() <= limit) {
    if (result.size() + kEllipsis.size() <= limit) fits = result.size();
    const std::size_t length = sendable_length(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      result += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[0]));
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  if (result.size() <= limit) return result;
  result.resize(fits);
  result += kEllipsis;
  return result;
}

}  // namespace dripline::dds
