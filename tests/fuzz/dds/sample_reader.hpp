#pragma once

#include <dripline.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "protocol/base/crc32.hpp"

namespace dripline::dds::fuzz {

/// Fills generated structs from fuzzed bytes, as Cyclone's CDR reader would: texts end within their
/// arrays, sequences keep their bounds, everything else is arbitrary. Missing bytes read as zero.
/// The format is that of the corpus: numbers little-endian, texts and sequences after a 16-bit
/// length.
class SampleReader {
 public:
  explicit SampleReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  void read(dripline_idl_Announce& s) {
    all(s.machine, s.control, s.version, s.protocol, s.epoch, s.session, s.description, s.heard);
  }
  void read(dripline_idl_Status& s) {
    all(s.machine, s.time_us, s.execution, s.mode, s.run, s.program, s.sent, s.accepted, s.executed,
        s.total_bytes, s.offset, s.line, s.sequence_number);
    positions_.resize(std::min<std::size_t>(number<std::uint16_t>(), 9));
    for (double& value : positions_) one(value);
    s.position._maximum = s.position._length = static_cast<std::uint32_t>(positions_.size());
    s.position._buffer = positions_.data();
    all(s.feed_mm_per_min, s.spindle_rpm, s.feed_override, s.rapid_override, s.spindle_override,
        s.buffered_seconds, s.single_block, s.message, s.outbox, s.axes, s.session);
    read(s.modes);
    read(s.coordinates);
    all(s.emergency_stop, s.steady_us, s.remote_enable, s.waits_for);
  }
  void read(dripline_idl_ActiveModes& s) {
    all(s.is_told, s.motion, s.compensation, s.is_inch, s.is_incremental, s.feed_unit, s.feed,
        s.is_feed_limited, s.tool, s.next_tool, s.tool_offset, s.tool_length_x, s.tool_length_z,
        s.tool_radius, s.work_system, s.cycle, s.dwell_seconds, s.is_surface_speed, s.spindle_speed,
        s.spindle_load, s.flood, s.mist, s.tool_axis, s.spindle);
  }
  void read(dripline_idl_Coordinates& s) {
    all(s.is_told, s.target, s.has_lag, s.lag, s.has_program, s.program_position, s.program_target,
        s.datum, s.shift, s.rotation, s.basic_rotation, s.scale, s.mirrored, s.pole_axes, s.pole);
  }
  void read(dripline_idl_Record& s) {
    all(s.machine, s.epoch, s.number, s.time_us, s.run, s.kind, s.block, s.line, s.sequence_number,
        s.device, s.text);
  }
  void read(dripline_idl_RecordAck& s) { all(s.machine, s.epoch, s.number); }
  void read(dripline_idl_Command& s) {
    all(s.machine, s.id, s.expires_us, s.action, s.run, s.program, s.revision, s.size, s.control,
        s.argument, s.value, s.session, s.server, s.number, s.deadline_us);
  }
  void read(dripline_idl_CommandResult& s) { all(s.machine, s.id, s.accepted, s.reason); }
  void read(dripline_idl_BlockRequest& s) {
    all(s.machine, s.session, s.run, s.program, s.offset, s.length);
  }
  void read(dripline_idl_BlockData& s) {
    all(s.machine, s.session, s.run, s.program, s.status, s.offset, s.total_bytes, s.ends);
    const auto bytes = take(std::min<std::size_t>(number<std::uint16_t>(), 32768));
    block_.assign(bytes.begin(), bytes.end());
    s.bytes._maximum = s.bytes._length = static_cast<std::uint32_t>(block_.size());
    s.bytes._buffer = block_.data();
    // A fuzzer does not find checksums: zero is replaced by the right one.
    one(s.crc);
    if (s.crc == 0) s.crc = crc32(std::as_bytes(std::span(block_)));
    one(s.reason);
  }

 private:
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
  void one(T& value) {
    value = number<T>();
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
  template <class... T>
  void all(T&... members) {
    (one(members), ...);
  }

  std::span<const std::uint8_t> bytes_;
  std::vector<double> positions_;
  std::vector<std::uint8_t> block_;
};

}  // namespace dripline::dds::fuzz
