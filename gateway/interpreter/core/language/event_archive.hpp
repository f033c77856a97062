#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_vector.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/language/state_archive.hpp"

/// The bytes of events and of the values they consist of, for the snapshots of stages and dialects:
/// `visit` lists the members once, for writing and for reading (`state_archive.hpp`). A number that
/// is not finite and an enumerator that does not exist are damage. The functions are in the
/// archives' namespace, so that argument-dependent look-up finds them from every dialect.
namespace dripline::interpreter::language {

/// A number that geometry can work with.
template <class Archive>
void visit(Archive& archive, double& number) {
  archive(number);
  if (!std::isfinite(number)) archive.damage();
}
template <class Archive, class... Numbers>
void visit_numbers(Archive& archive, Numbers&... numbers) {
  (visit(archive, numbers), ...);
}

template <class Archive, class Enum>
void up_to(Archive& archive, Enum& value, Enum last) {
  auto number = static_cast<std::uint8_t>(value);
  archive(number);
  if (number > static_cast<std::uint8_t>(last)) return archive.damage();
  value = static_cast<Enum>(number);
}

template <class Archive>
void visit(Archive& archive, PlaneVector& vector) {
  visit_numbers(archive, vector.first, vector.second);
}
template <class Archive>
void visit(Archive& archive, Length& length) {
  double mm = length.mm();
  visit(archive, mm);
  length = Length::mm(mm);
}
template <class Archive>
void visit(Archive& archive, Angle& angle) {
  double degrees = angle.degrees();
  visit(archive, degrees);
  angle = Angle::degrees(degrees);
}
template <class Archive>
void visit(Archive& archive, Origin& origin) {
  visit_all(archive, origin.block, origin.offset, origin.line, origin.sequence, origin.program);
}
template <class Archive>
void visit(Archive& archive, TextPlace& place) {
  visit_all(archive, place.program, place.offset, place.line);
}
template <class Archive>
void visit(Archive& archive, Position& position) {
  for (const Axis axis : kAllAxes) {
    bool has = position.has(axis);
    double value = position.raw(axis);
    archive(has);
    visit(archive, value);
    position.set_raw(axis, value);
    if (!has) position.unmark(axis);
  }
}
template <class Archive>
void visit(Archive& archive, Feed& feed) {
  Feed::Per per = feed.per();
  up_to(archive, per, Feed::Per::Move);
  double number = per == Feed::Per::Move ? feed.moves_per_minute() : feed.length().mm();
  visit(archive, number);
  if (per == Feed::Per::Minute) feed = Feed::per_minute(Length::mm(number));
  if (per == Feed::Per::Revolution) feed = Feed::per_revolution(Length::mm(number));
  if (per == Feed::Per::Move) feed = Feed::inverse_time(number);
}
template <class Archive>
void visit(Archive& archive, ToolShape& shape) {
  visit(archive, shape.length);
  visit(archive, shape.radius);
}
template <class Archive, class Value>
void visit_optional(Archive& archive, std::optional<Value>& optional) {
  bool has = optional.has_value();
  archive(has);
  if (!has) return optional.reset();
  if (!optional) optional.emplace();
  visit(archive, *optional);
}

/// Bytes of a part that writes and reads itself; more than `most` are damage.
template <class Archive>
void visit_bytes(Archive& archive, std::vector<std::byte>& bytes, std::size_t most) {
  std::size_t count = bytes.size();
  if (!archive.size(count, most)) return;
  bytes.resize(count);
  for (std::byte& byte : bytes) archive(byte);
}

template <class Archive>
void visit(Archive& archive, Rapid& event) {
  visit(archive, event.origin);
  visit(archive, event.to);
  archive(event.rests);
}
template <class Archive>
void visit(Archive& archive, Line& event) {
  visit(archive, event.origin);
  visit(archive, event.to);
  visit(archive, event.feed);
  archive(event.rests);
}
template <class Archive>
void visit(Archive& archive, Arc& event) {
  visit(archive, event.origin);
  visit(archive, event.to);
  visit(archive, event.center_first);
  visit(archive, event.center_second);
  up_to(archive, event.plane, Plane::YZ);
  up_to(archive, event.turn, Turn::Counterclockwise);
  visit(archive, event.sweep);
  visit(archive, event.feed);
  archive(event.rests);
}
template <class Archive>
void visit(Archive& archive, ThreadArc& arc) {
  visit(archive, arc.center_first);
  visit(archive, arc.center_second);
  up_to(archive, arc.plane, Plane::YZ);
  up_to(archive, arc.turn, Turn::Counterclockwise);
  visit(archive, arc.sweep);
}
template <class Archive>
void visit(Archive& archive, Thread& event) {
  visit(archive, event.origin);
  visit(archive, event.to);
  visit(archive, event.lead);
  visit_optional(archive, event.start_angle);
  visit_optional(archive, event.arc);
  visit(archive, event.lead_change);
}
template <class Archive>
void visit(Archive& archive, Dwell& event) {
  visit(archive, event.origin);
  visit(archive, event.seconds);
  visit_optional(archive, event.revolutions);
}
template <class Archive>
void visit(Archive& archive, Spindle& event) {
  visit(archive, event.origin);
  up_to(archive, event.state, SpindleState::Oriented);
  visit(archive, event.revolutions_per_minute);
  visit_optional(archive, event.surface_speed);
  visit_optional(archive, event.max_revolutions);
}
template <class Archive>
void visit(Archive& archive, Coolant& event) {
  visit(archive, event.origin);
  visit_all(archive, event.flood, event.mist);
}
template <class Archive>
void visit(Archive& archive, ToolChange& event) {
  visit(archive, event.origin);
  bool has_offset = event.offset.has_value();
  int offset = event.offset.value_or(0);
  visit_all(archive, event.number, event.is_preselection, has_offset, offset);
  event.offset = has_offset ? std::optional(offset) : std::nullopt;
  visit_optional(archive, event.shape);
}
template <class Archive>
void visit(Archive& archive, Miscellaneous& event) {
  visit(archive, event.origin);
  archive(event.code);
}
template <class Archive>
void visit(Archive& archive, PinChange& event) {
  visit(archive, event.origin);
  up_to(archive, event.axis, Axis::W);
  visit_all(archive, event.output, event.state);
  visit_optional(archive, event.pulse_ms);
}
template <class Archive>
void visit(Archive& archive, Stop& event) {
  visit(archive, event.origin);
  up_to(archive, event.kind, StopKind::Operator);
}
template <class Archive>
void visit(Archive& archive, UnitsChange& event) {
  visit(archive, event.origin);
  up_to(archive, event.units, Units::Millimetre);
}
template <class Archive>
void visit(Archive& archive, Close& event) {
  visit(archive, event.origin);
  up_to(archive, event.device, OutputDevice::Printer);
}
template <class Archive>
void visit(Archive& archive, OverrideInhibit& event) {
  visit(archive, event.origin);
  visit_all(archive, event.feed_override, event.spindle_override, event.single_block);
  up_to(archive, event.hold, FeedHoldInhibit::LaterToo);
  archive(event.is_tapping);
}

}  // namespace dripline::interpreter::language
