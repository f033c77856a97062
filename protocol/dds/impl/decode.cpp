#include "protocol/dds/impl/decode.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "protocol/base/crc32.hpp"
#include "protocol/dds/impl/check.hpp"
#include "protocol/dds/impl/utf8.hpp"

namespace dripline::dds {
namespace {

UtcTime time_point(std::int64_t microseconds) {
  return UtcTime{std::chrono::microseconds{microseconds}};
}

/// Takes members over and remembers the first that cannot be.
class Members {
 public:
  template <std::size_t N>
  std::string text(const char (&field)[N], std::string_view member) {
    const char* end = std::find(field, field + N, '\0');
    std::string result(field, end);
    if (end == field + N || !is_sendable_text(result)) blame(member, "is not UTF-8 text");
    return result;
  }
  template <class Enum>
  Enum enumerator(std::uint8_t value, Enum last, std::string_view member) {
    if (value <= static_cast<std::uint8_t>(last)) return static_cast<Enum>(value);
    blame(member, fmt::format("has no meaning for {}", value));
    return last;
  }
  void blame(std::string_view member, std::string_view what, Errc code = Errc::Syntax) {
    if (!wrong_) wrong_ = Error{code, fmt::format("{} {}", member, what)};
  }
  template <class Message>
  Result<Message> finish(Message message) {
    if (wrong_) return fail(*wrong_);
    if (auto checked = check(message); !checked) return fail(checked.error());
    return message;
  }

 private:
  std::optional<Error> wrong_;
};

std::span<const std::byte> as_bytes(const dds_sequence_octet& sequence) {
  return std::as_bytes(std::span(sequence._buffer, sequence._length));
}

std::optional<std::int32_t> number_or_none(std::int32_t value) {
  return value < 0 ? std::nullopt : std::optional(value);
}

ActiveModes modes_of(const dripline_idl_ActiveModes& s, Members& members) {
  ActiveModes m;
  m.motion = members.enumerator(s.motion, MotionKind::Thread, "motion");
  m.compensation = members.enumerator(s.compensation, CompensationSide::Right, "compensation");
  m.is_inch = s.is_inch;
  m.is_incremental = s.is_incremental;
  m.feed_unit = members.enumerator(s.feed_unit, FeedUnit::InverseTime, "feed_unit");
  m.feed = s.feed;
  m.is_feed_limited = s.is_feed_limited;
  m.tool = number_or_none(s.tool);
  m.next_tool = number_or_none(s.next_tool);
  m.tool_offset = number_or_none(s.tool_offset);
  m.tool_length_x = s.tool_length_x;
  m.tool_length_z = s.tool_length_z;
  m.tool_radius = s.tool_radius;
  m.work_system = members.text(s.work_system, "work_system");
  m.cycle = members.text(s.cycle, "cycle");
  m.dwell_seconds = s.dwell_seconds;
  m.is_surface_speed = s.is_surface_speed;
  m.spindle_speed = s.spindle_speed;
  if (s.spindle_load >= 0) m.spindle_load = s.spindle_load;
  m.flood = s.flood;
  m.mist = s.mist;
  if (s.tool_axis > 9)
    members.blame("tool_axis", fmt::format("has no meaning for {}", s.tool_axis));
  if (s.tool_axis > 0) m.tool_axis = static_cast<std::uint8_t>(s.tool_axis - 1);
  m.spindle = members.enumerator(s.spindle, SpindleState::Oriented, "spindle");
  return m;
}

template <std::size_t N>
std::array<double, N> numbers(const double (&field)[N]) {
  std::array<double, N> result;
  std::copy_n(field, N, result.begin());
  return result;
}

ProgramFrame frame_of(const dripline_idl_Coordinates& s) {
  ProgramFrame m;
  m.position = numbers(s.program_position);
  m.target = numbers(s.program_target);
  m.datum = numbers(s.datum);
  m.shift = numbers(s.shift);
  m.rotation = s.rotation;
  m.basic_rotation = s.basic_rotation;
  m.scale = numbers(s.scale);
  m.mirrored = s.mirrored;
  m.pole_axes = s.pole_axes;
  m.pole = numbers(s.pole);
  return m;
}

Coordinates coordinates_of(const dripline_idl_Coordinates& s) {
  Coordinates m;
  m.target = numbers(s.target);
  if (s.has_lag) m.lag = numbers(s.lag);
  if (s.has_program) m.program = frame_of(s);
  return m;
}

}  // namespace

Result<Announce> decode(const dripline_idl_Announce& s) {
  Members members;
  Announce m;
  m.machine = members.text(s.machine, "machine");
  m.control = members.text(s.control, "control");
  m.version = members.text(s.version, "version");
  m.protocol = s.protocol;
  m.epoch = s.epoch;
  m.session = s.session;
  m.description = members.text(s.description, "description");
  return members.finish(std::move(m));
}

Result<Status> decode(const dripline_idl_Status& s) {
  Members members;
  Status m;
  m.machine = members.text(s.machine, "machine");
  m.time = time_point(s.time_us);
  m.execution = members.enumerator(s.execution, Execution::Waiting, "execution");
  m.mode = members.enumerator(s.mode, ControllerMode::Manual, "mode");
  m.run = members.text(s.run, "run");
  m.program = members.text(s.program, "program");
  m.sent = s.sent;
  m.accepted = s.accepted;
  m.executed = s.executed;
  m.total_bytes = s.total_bytes;
  m.offset = s.offset;
  m.line = s.line;
  m.sequence = s.sequence_number;
  if (s.position._length == m.position.size()) {
    std::copy_n(s.position._buffer, m.position.size(), m.position.begin());
  } else {
    members.blame("position", "does not have nine axes");
  }
  m.feed_mm_per_min = s.feed_mm_per_min;
  m.spindle_rpm = s.spindle_rpm;
  m.feed_override = s.feed_override;
  m.rapid_override = s.rapid_override;
  m.spindle_override = s.spindle_override;
  m.buffered_seconds = s.buffered_seconds;
  m.single_block = s.single_block;
  m.message = members.text(s.message, "message");
  m.outbox = s.outbox;
  m.axes = s.axes;
  m.session = s.session;
  if (s.modes.is_told) m.modes = modes_of(s.modes, members);
  if (s.coordinates.is_told) m.coordinates = coordinates_of(s.coordinates);
  m.emergency_stop = s.emergency_stop;
  m.steady = std::chrono::microseconds{s.steady_us};
  m.remote_enable = members.enumerator(s.remote_enable, RemoteEnable::NotGiven, "remote_enable");
  m.waits_for = members.enumerator(s.waits_for, WaitsFor::Disk, "waits_for");
  return members.finish(std::move(m));
}

Result<Record> decode(const dripline_idl_Record& s) {
  Members members;
  Record m;
  m.machine = members.text(s.machine, "machine");
  m.epoch = s.epoch;
  m.number = s.number;
  m.time = time_point(s.time_us);
  m.run = members.text(s.run, "run");
  m.kind = members.enumerator(s.kind, RecordKind::DeviceClosed, "kind");
  m.block = s.block;
  m.line = s.line;
  m.sequence = s.sequence_number;
  m.device = members.text(s.device, "device");
  m.text = members.text(s.text, "text");
  return members.finish(std::move(m));
}

Result<RecordAck> decode(const dripline_idl_RecordAck& s) {
  Members members;
  return members.finish(RecordAck{members.text(s.machine, "machine"), s.epoch, s.number});
}

Result<Command> decode(const dripline_idl_Command& s) {
  Members members;
  Command m;
  m.machine = members.text(s.machine, "machine");
  m.id = members.text(s.id, "id");
  m.expires = time_point(s.expires_us);
  m.action = members.enumerator(s.action, CommandAction::Refuse, "action");
  m.run = members.text(s.run, "run");
  m.program = members.text(s.program, "program");
  m.revision = members.text(s.revision, "revision");
  m.size = s.size;
  m.control = members.text(s.control, "control");
  m.argument = members.text(s.argument, "argument");
  m.value = s.value;
  m.session = s.session;
  m.server = s.server;
  m.number = s.number;
  m.deadline = std::chrono::microseconds{s.deadline_us};
  if (const auto setup = as_bytes(s.setup); setup.size() <= kMaxCommandSetup) {
    m.setup.assign(reinterpret_cast<const char*>(setup.data()), setup.size());
  } else {
    members.blame("setup", "is too long");
  }
  return members.finish(std::move(m));
}

Result<CommandResult> decode(const dripline_idl_CommandResult& s) {
  Members members;
  CommandResult m;
  m.machine = members.text(s.machine, "machine");
  m.id = members.text(s.id, "id");
  m.accepted = s.accepted;
  m.reason = members.text(s.reason, "reason");
  return members.finish(std::move(m));
}

Result<BlockRequest> decode(const dripline_idl_BlockRequest& s) {
  Members members;
  BlockRequest m;
  m.machine = members.text(s.machine, "machine");
  m.session = s.session;
  m.run = members.text(s.run, "run");
  m.program = members.text(s.program, "program");
  m.offset = s.offset;
  m.length = s.length;
  return members.finish(std::move(m));
}

Result<BlockData> decode(const dripline_idl_BlockData& s) {
  Members members;
  BlockData m;
  m.machine = members.text(s.machine, "machine");
  m.session = s.session;
  m.run = members.text(s.run, "run");
  m.program = members.text(s.program, "program");
  m.status = members.enumerator(s.status, BlockStatus::Failed, "status");
  m.offset = s.offset;
  m.total_bytes = s.total_bytes;
  m.ends = s.ends;
  m.reason = members.text(s.reason, "reason");
  const auto bytes = as_bytes(s.bytes);
  if (bytes.size() > kMaxBlockBytes) {
    members.blame("bytes", "are too many");
  } else if (crc32(bytes) != s.crc) {
    members.blame("bytes", "do not match their CRC", Errc::Corrupt);
  } else {
    m.bytes.assign(bytes.begin(), bytes.end());
  }
  return members.finish(std::move(m));
}

}  // namespace dripline::dds
