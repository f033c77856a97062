#include "protocol/dds/impl/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/base/digest.hpp"
#include "protocol/base/names.hpp"
#include "protocol/dds/impl/utf8.hpp"

namespace dripline::dds {
namespace {

/// Epochs are kept as signed numbers at both ends.
bool is_epoch(std::uint64_t epoch) {
  return epoch >= 1 && epoch <= INT64_MAX;
}

/// Collects the verdicts on the members of one message; the first failure stays.
class Verdict {
 public:
  explicit Verdict(std::string_view message) : message_(message) {}

  Verdict& machine(const std::string& name) { return take("machine", check_machine_name(name)); }
  Verdict& program(const std::string& name) {
    return name.empty() ? *this : take("program", check_program_name(name));
  }
  /// Ids and short words: printable ASCII without blanks; may be empty.
  Verdict& word(std::string_view member, const std::string& text) {
    const bool is_plain =
        std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
    return that(is_plain, member, "is not a plain word");
  }
  Verdict& id(std::string_view member, const std::string& text) {
    return that(!text.empty(), member, "is empty").word(member, text);
  }
  Verdict& number(std::string_view member, double value) {
    return that(std::isfinite(value), member, "is not finite");
  }
  template <std::size_t N>
  Verdict& numbers(std::string_view member, const std::array<double, N>& values) {
    for (const double value : values) number(member, value);
    return *this;
  }
  Verdict& that(bool holds, std::string_view member, std::string_view otherwise) {
    if (holds || !result_) return *this;
    result_ = fail(Errc::Syntax, "{}: {} {}", message_, member, otherwise);
    return *this;
  }
  Result<void> result() const { return result_; }

 private:
  Verdict& take(std::string_view member, const Result<void>& checked) {
    return checked ? *this : that(false, member, checked.error().what);
  }

  std::string_view message_;
  Result<void> result_;
};

}  // namespace

Result<void> check(const Announce& m) {
  return Verdict("announce")
      .machine(m.machine)
      .word("control", m.control)
      .that(is_epoch(m.epoch), "epoch", "is out of range")
      .result();
}

namespace {

void check(const Coordinates& m, Verdict& verdict) {
  verdict.numbers("target", m.target);
  if (m.lag) verdict.numbers("lag", *m.lag);
  if (!m.program) return;
  const ProgramFrame& frame = *m.program;
  constexpr std::uint8_t kBeyondZ = 0xF8;
  verdict.numbers("program_position", frame.position)
      .numbers("program_target", frame.target)
      .numbers("datum", frame.datum)
      .numbers("shift", frame.shift)
      .number("rotation", frame.rotation)
      .number("basic_rotation", frame.basic_rotation)
      .numbers("scale", frame.scale)
      .that((frame.mirrored & kBeyondZ) == 0, "mirrored", "names an axis beyond Z")
      .that((frame.pole_axes & kBeyondZ) == 0, "pole_axes", "names an axis beyond Z")
      .numbers("pole", frame.pole);
}

}  // namespace

Result<void> check(const Status& m) {
  Verdict verdict("status");
  verdict.machine(m.machine)
      .word("run", m.run)
      .number("feed_mm_per_min", m.feed_mm_per_min)
      .number("spindle_rpm", m.spindle_rpm)
      .number("feed_override", m.feed_override)
      .number("rapid_override", m.rapid_override)
      .number("spindle_override", m.spindle_override)
      .number("buffered_seconds", m.buffered_seconds);
  for (const double value : m.position) verdict.number("position", value);
  if (m.modes) {
    verdict.number("feed", m.modes->feed)
        .number("tool_length_x", m.modes->tool_length_x)
        .number("tool_length_z", m.modes->tool_length_z)
        .number("tool_radius", m.modes->tool_radius)
        .number("dwell_seconds", m.modes->dwell_seconds)
        .number("spindle_speed", m.modes->spindle_speed)
        .number("spindle_load", m.modes->spindle_load.value_or(0));
  }
  if (m.modes && m.modes->tool_axis)
    verdict.that(*m.modes->tool_axis < m.position.size(), "tool_axis", "is no axis");
  if (m.coordinates) check(*m.coordinates, verdict);
  return verdict.result();
}

Result<void> check(const Record& m) {
  return Verdict("record")
      .machine(m.machine)
      .that(is_epoch(m.epoch), "epoch", "is out of range")
      .that(m.number >= 1, "number", "is not positive")
      .word("run", m.run)
      .word("device", m.device)
      .result();
}

Result<void> check(const RecordAck& m) {
  return Verdict("record_ack").machine(m.machine).result();
}

Result<void> check(const Command& m) {
  Verdict verdict("order");
  verdict.machine(m.machine)
      .id("id", m.id)
      .word("run", m.run)
      .program(m.program)
      .word("control", m.control)
      .number("value", m.value)
      .that(m.revision.empty() || parse_digest(m.revision), "revision", "is not a SHA-256")
      .that(m.setup.size() <= kMaxCommandSetup, "setup", "is too long")
      .that(is_sendable_text(m.setup), "setup", "is not UTF-8 text");
  if (m.action == CommandAction::Start) {
    verdict.id("run", m.run)
        .that(!m.program.empty(), "program", "is empty")
        .that(!m.revision.empty(), "revision", "is empty");
  }
  return verdict.result();
}

Result<void> check(const CommandResult& m) {
  return Verdict("command_result").machine(m.machine).id("id", m.id).result();
}

Result<void> check(const BlockRequest& m) {
  return Verdict("block_request")
      .machine(m.machine)
      .id("run", m.run)
      .program(m.program)
      .that(m.length >= 1 && m.length <= kMaxRequestBytes, "length", "is out of range")
      .that(m.offset <= UINT64_MAX - m.length, "offset", "is out of range")
      .result();
}

Result<void> check(const BlockData& m) {
  Verdict verdict("block_data");
  verdict.machine(m.machine).id("run", m.run).program(m.program);
  verdict.that(m.bytes.size() <= kMaxBlockBytes, "bytes", "are too many");
  if (m.status != BlockStatus::Ok) {
    return verdict.that(m.bytes.empty(), "bytes", "come with a failure").result();
  }
  const bool fits = m.offset <= m.total_bytes && m.bytes.size() <= m.total_bytes - m.offset;
  const bool reaches_end = fits && m.offset + m.bytes.size() == m.total_bytes;
  return verdict.that(fits, "bytes", "lie beyond the total")
      .that(!m.ends || reaches_end, "ends", "is set before the total")
      .result();
}

}  // namespace dripline::dds
