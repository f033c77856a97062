#include "protocol/dds/impl/encode.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "protocol/base/crc32.hpp"
#include "protocol/dds/impl/check.hpp"
#include "protocol/dds/impl/utf8.hpp"

namespace dripline::dds {
namespace {

std::int64_t microseconds(UtcTime time) {
  return time.time_since_epoch().count();
}

template <class Enum>
std::uint8_t number(Enum value) {
  return static_cast<std::uint8_t>(value);
}

/// Fills the character arrays of one sample; the first text that does not fit is remembered.
class Texts {
 public:
  template <std::size_t N>
  Texts& exact(char (&field)[N], const std::string& text, std::string_view member) {
    if (text.size() >= N) {
      if (result_) {
        result_ =
            fail(Errc::LimitExceeded, "{} has {} bytes, at most {}", member, text.size(), N - 1);
      }
      return *this;
    }
    if (!is_sendable_text(text)) {
      if (result_) result_ = fail(Errc::Syntax, "{} is not UTF-8", member);
      return *this;
    }
    copy(field, text);
    return *this;
  }
  template <std::size_t N>
  Texts& free(char (&field)[N], const std::string& text) {
    copy(field, make_sendable(text, N - 1));
    return *this;
  }
  Result<void> result() const { return result_; }

 private:
  template <std::size_t N>
  void copy(char (&field)[N], const std::string& text) {
    std::memcpy(field, text.data(), text.size());
    field[text.size()] = '\0';
  }
  Result<void> result_;
};

std::int32_t number_or_none(const std::optional<std::int32_t>& value) {
  return value.value_or(-1);
}

Result<void> encode(const ActiveModes& m, dripline_idl_ActiveModes& s) {
  s.is_told = true;
  s.motion = number(m.motion);
  s.compensation = number(m.compensation);
  s.is_inch = m.is_inch;
  s.is_incremental = m.is_incremental;
  s.feed_unit = number(m.feed_unit);
  s.feed = m.feed;
  s.is_feed_limited = m.is_feed_limited;
  s.tool = number_or_none(m.tool);
  s.next_tool = number_or_none(m.next_tool);
  s.tool_offset = number_or_none(m.tool_offset);
  s.tool_length_x = m.tool_length_x;
  s.tool_length_z = m.tool_length_z;
  s.tool_radius = m.tool_radius;
  s.dwell_seconds = m.dwell_seconds;
  s.is_surface_speed = m.is_surface_speed;
  s.spindle_speed = m.spindle_speed;
  s.spindle_load = m.spindle_load.value_or(-1);
  s.flood = m.flood;
  s.mist = m.mist;
  if (m.tool_axis) s.tool_axis = static_cast<std::uint8_t>(*m.tool_axis + 1);
  s.spindle = number(m.spindle);
  return Texts()
      .exact(s.work_system, m.work_system, "work_system")
      .exact(s.cycle, m.cycle, "cycle")
      .result();
}

template <std::size_t N>
void copy(const std::array<double, N>& numbers, double (&field)[N]) {
  std::copy(numbers.begin(), numbers.end(), field);
}

void encode(const Coordinates& m, dripline_idl_Coordinates& s) {
  s.is_told = true;
  copy(m.target, s.target);
  s.has_lag = m.lag.has_value();
  if (m.lag) copy(*m.lag, s.lag);
  s.has_program = m.program.has_value();
  if (!m.program) return;
  copy(m.program->position, s.program_position);
  copy(m.program->target, s.program_target);
  copy(m.program->datum, s.datum);
  copy(m.program->shift, s.shift);
  s.rotation = m.program->rotation;
  s.basic_rotation = m.program->basic_rotation;
  copy(m.program->scale, s.scale);
  s.mirrored = m.program->mirrored;
  s.pole_axes = m.program->pole_axes;
  copy(m.program->pole, s.pole);
}

}  // namespace

Result<void> encode(const Announce& m, dripline_idl_Announce& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.protocol = m.protocol;
  s.epoch = m.epoch;
  s.session = m.session;
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.control, m.control, "control")
      .exact(s.version, m.version, "version")
      .free(s.description, m.description)
      .result();
}

Result<void> encode(const Status& m, dripline_idl_Status& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.time_us = microseconds(m.time);
  s.execution = number(m.execution);
  s.mode = number(m.mode);
  s.sent = m.sent;
  s.accepted = m.accepted;
  s.executed = m.executed;
  s.total_bytes = m.total_bytes;
  s.offset = m.offset;
  s.line = m.line;
  s.sequence_number = m.sequence;
  s.position._maximum = s.position._length = static_cast<std::uint32_t>(m.position.size());
  s.position._buffer = const_cast<double*>(m.position.data());  // borrowed, read only
  s.feed_mm_per_min = m.feed_mm_per_min;
  s.spindle_rpm = m.spindle_rpm;
  s.feed_override = m.feed_override;
  s.rapid_override = m.rapid_override;
  s.spindle_override = m.spindle_override;
  s.buffered_seconds = m.buffered_seconds;
  s.single_block = m.single_block;
  s.outbox = m.outbox;
  s.axes = m.axes;
  s.session = m.session;
  if (m.modes) {
    if (auto encoded = encode(*m.modes, s.modes); !encoded) return encoded;
  }
  if (m.coordinates) encode(*m.coordinates, s.coordinates);
  s.emergency_stop = m.emergency_stop;
  s.steady_us = m.steady.count();
  s.remote_enable = number(m.remote_enable);
  s.waits_for = number(m.waits_for);
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.run, m.run, "run")
      .exact(s.program, m.program, "program")
      .free(s.message, m.message)
      .result();
}

Result<void> encode(const Record& m, dripline_idl_Record& s) {
  if (auto checked = check(m); !checked) return checked;
  if (m.text.size() > kMaxRecordText) {
    return fail(Errc::LimitExceeded, "record text has {} bytes, at most {}", m.text.size(),
                kMaxRecordText);
  }
  s = {};
  s.epoch = m.epoch;
  s.number = m.number;
  s.time_us = microseconds(m.time);
  s.kind = number(m.kind);
  s.block = m.block;
  s.line = m.line;
  s.sequence_number = m.sequence;
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.run, m.run, "run")
      .exact(s.device, m.device, "device")
      .free(s.text, m.text)
      .result();
}

Result<void> encode(const RecordAck& m, dripline_idl_RecordAck& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.epoch = m.epoch;
  s.number = m.number;
  return Texts().exact(s.machine, m.machine, "machine").result();
}

Result<void> encode(const Command& m, dripline_idl_Command& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.expires_us = microseconds(m.expires);
  s.action = number(m.action);
  s.size = m.size;
  s.value = m.value;
  s.session = m.session;
  s.server = m.server;
  s.number = m.number;
  s.deadline_us = m.deadline.count();
  s.setup._maximum = s.setup._length = static_cast<std::uint32_t>(m.setup.size());
  // Borrowed, read only.
  s.setup._buffer = reinterpret_cast<std::uint8_t*>(const_cast<char*>(m.setup.data()));
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.id, m.id, "id")
      .exact(s.run, m.run, "run")
      .exact(s.program, m.program, "program")
      .exact(s.revision, m.revision, "revision")
      .exact(s.control, m.control, "control")
      .exact(s.argument, m.argument, "argument")
      .result();
}

Result<void> encode(const CommandResult& m, dripline_idl_CommandResult& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.accepted = m.accepted;
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.id, m.id, "id")
      .free(s.reason, m.reason)
      .result();
}

Result<void> encode(const BlockRequest& m, dripline_idl_BlockRequest& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.session = m.session;
  s.offset = m.offset;
  s.length = m.length;
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.run, m.run, "run")
      .exact(s.program, m.program, "program")
      .result();
}

Result<void> encode(const BlockData& m, dripline_idl_BlockData& s) {
  if (auto checked = check(m); !checked) return checked;
  s = {};
  s.session = m.session;
  s.status = number(m.status);
  s.offset = m.offset;
  s.total_bytes = m.total_bytes;
  s.ends = m.ends;
  s.crc = crc32(m.bytes);
  s.bytes._maximum = s.bytes._length = static_cast<std::uint32_t>(m.bytes.size());
  // Borrowed, read only.
  s.bytes._buffer = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(m.bytes.data()));
  return Texts()
      .exact(s.machine, m.machine, "machine")
      .exact(s.run, m.run, "run")
      .exact(s.program, m.program, "program")
      .free(s.reason, m.reason)
      .result();
}

}  // namespace dripline::dds
