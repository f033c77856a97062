#pragma once

#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "gateway/interpreter/core/geometry/plane_vector.hpp"
#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

/// The bytes of events that wait, for the snapshots of stages that look ahead: `visit` for what
/// their states are made of, written and read by the same lines (`state_archive.hpp`). Numbers that
/// geometry cannot work with and enumerators that do not exist are damage.
namespace dripline::interpreter::look_ahead {

using language::StateReader;
using language::StateWriter;
using language::visit_all;

template <class Archive>
void fail(Archive& archive) {
  if constexpr (Archive::kReads) archive.damage();
}

/// A number that geometry can work with.
template <class Archive>
void visit(Archive& archive, double& number) {
  archive(number);
  if (!std::isfinite(number)) fail(archive);
}
template <class Archive, class... Numbers>
void visit_numbers(Archive& archive, Numbers&... numbers) {
  (visit(archive, numbers), ...);
}

template <class Archive, class Enum>
void up_to(Archive& archive, Enum& value, Enum last) {
  auto number = static_cast<std::uint8_t>(value);
  archive(number);
  if (number > static_cast<std::uint8_t>(last)) return fail(archive);
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

template <class Archive>
void visit(Archive& archive, BlockEnd& event) {
  visit(archive, event.origin);
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
template <class Archive>
void visit(Archive& archive, HeldText& text) {
  up_to(archive, text.kind, HeldText::Kind::Message);
  up_to(archive, text.device, OutputDevice::Printer);
  visit(archive, text.origin);
  archive(text.size);
}

template <class Held>
void write_held(StateWriter& archive, const Held& held) {
  auto count = static_cast<std::uint16_t>(held.size());
  archive(count);
  for (std::size_t i = 0; i < held.size(); ++i) {
    typename Held::Event event = held[i];
    auto kind = static_cast<std::uint8_t>(event.index());
    archive(kind);
    std::visit([&](auto& one) { visit(archive, one); }, event);
    if (const auto* text = std::get_if<HeldText>(&event)) {
      for (char c : held.text(*text)) archive(c);
    }
  }
}

template <class Event, class Held>
void read_event(StateReader& archive, Held& held) {
  Event event{};
  visit(archive, event);
  if constexpr (std::is_same_v<Event, HeldText>) {
    if (event.size > kMaxHeldText) fail(archive);
    std::array<char, kMaxHeldText> content;
    for (std::uint32_t i = 0; i < event.size && !archive.is_damaged(); ++i) archive(content[i]);
    if (!archive.is_damaged() && !held.push(event, {content.data(), event.size})) fail(archive);
  } else {
    if (!archive.is_damaged() && !held.push(event)) fail(archive);
  }
}

template <class Held, std::size_t... Kinds>
void read_kind(StateReader& archive, Held& held, std::size_t kind, std::index_sequence<Kinds...>) {
  using Event = typename Held::Event;
  const bool is_known =
      ((kind == Kinds ? (read_event<std::variant_alternative_t<Kinds, Event>>(archive, held), true)
                      : false) ||
       ...);
  if (!is_known) fail(archive);
}

template <class Held>
void read_held(StateReader& archive, Held& held) {
  constexpr std::size_t kKinds = std::variant_size_v<typename Held::Event>;
  std::uint16_t count = 0;
  archive(count);
  held.clear();
  for (std::uint16_t i = 0; i < count && !archive.is_damaged(); ++i) {
    std::uint8_t kind = 0;
    archive(kind);
    read_kind(archive, held, kind, std::make_index_sequence<kKinds>{});
  }
}

}  // namespace dripline::interpreter::look_ahead
