#pragma once

#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/held_events.hpp"

/// Held events in a snapshot: the kinds that can wait after a move, member by member.
namespace dripline::interpreter::rs274ngc {

template <class Archive>
void visit_position(Archive& archive, Position& position) {
  for (const Axis axis : kAllAxes) {
    double value = position.raw(axis);
    bool has_moved = position.has(axis);
    language::visit_all(archive, value, has_moved);
    if constexpr (Archive::kReads) {
      position.set_raw(axis, value);
      if (!has_moved) position.unmark(axis);
    }
  }
}

template <class Archive>
void visit_origin(Archive& archive, Origin& origin) {
  language::visit_all(archive, origin.block, origin.offset, origin.line, origin.sequence,
                      origin.program);
}

template <class Archive>
void visit_feed(Archive& archive, Feed& feed) {
  auto per = feed.per();
  double value = per == Feed::Per::Move ? feed.moves_per_minute() : feed.length().mm();
  language::visit_all(archive, per, value);
  if constexpr (Archive::kReads) {
    feed = per == Feed::Per::Move     ? Feed::inverse_time(value)
           : per == Feed::Per::Minute ? Feed::per_minute(Length::mm(value))
                                      : Feed::per_revolution(Length::mm(value));
  }
}

template <class Archive>
void visit_length(Archive& archive, Length& length) {
  double mm = length.mm();
  archive(mm);
  length = Length::mm(mm);
}

template <class Archive>
void visit_value(Archive& archive, double& value) {
  archive(value);
}
template <class Archive>
void visit_value(Archive& archive, int& value) {
  archive(value);
}
template <class Archive>
void visit_value(Archive& archive, Length& length) {
  visit_length(archive, length);
}
template <class Archive>
void visit_value(Archive& archive, Angle& angle) {
  double degrees = angle.degrees();
  archive(degrees);
  angle = Angle::degrees(degrees);
}
template <class Archive>
void visit_value(Archive& archive, ToolShape& shape) {
  visit_length(archive, shape.length);
  visit_length(archive, shape.radius);
}
template <class Archive>
void visit_value(Archive& archive, ThreadArc& arc) {
  visit_length(archive, arc.center_first);
  visit_length(archive, arc.center_second);
  language::visit_all(archive, arc.plane, arc.turn);
  visit_value(archive, arc.sweep);
}

template <class Archive, class Value>
void visit_optional(Archive& archive, std::optional<Value>& value) {
  bool is_there = value.has_value();
  archive(is_there);
  if (!is_there) return value.reset();
  if (!value) value.emplace();
  visit_value(archive, *value);
}

template <class Archive>
void visit_event(Archive& archive, Rapid& event) {
  visit_origin(archive, event.origin);
  visit_position(archive, event.to);
  archive(event.rests);
}
template <class Archive>
void visit_event(Archive& archive, Line& event) {
  visit_origin(archive, event.origin);
  visit_position(archive, event.to);
  visit_feed(archive, event.feed);
  archive(event.rests);
}
template <class Archive>
void visit_event(Archive& archive, Arc& event) {
  visit_origin(archive, event.origin);
  visit_position(archive, event.to);
  visit_length(archive, event.center_first);
  visit_length(archive, event.center_second);
  double sweep = event.sweep.degrees();
  language::visit_all(archive, event.plane, event.turn, sweep);
  event.sweep = Angle::degrees(sweep);
  visit_feed(archive, event.feed);
  archive(event.rests);
}
template <class Archive>
void visit_event(Archive& archive, Thread& event) {
  visit_origin(archive, event.origin);
  visit_position(archive, event.to);
  visit_length(archive, event.lead);
  visit_optional(archive, event.start_angle);
  visit_optional(archive, event.arc);
  visit_length(archive, event.lead_change);
}
template <class Archive>
void visit_event(Archive& archive, Dwell& event) {
  visit_origin(archive, event.origin);
  archive(event.seconds);
  visit_optional(archive, event.revolutions);
}
template <class Archive>
void visit_event(Archive& archive, Spindle& event) {
  visit_origin(archive, event.origin);
  language::visit_all(archive, event.state, event.revolutions_per_minute);
  visit_optional(archive, event.surface_speed);
  visit_optional(archive, event.max_revolutions);
}
template <class Archive>
void visit_event(Archive& archive, Coolant& event) {
  visit_origin(archive, event.origin);
  language::visit_all(archive, event.flood, event.mist);
}
template <class Archive>
void visit_event(Archive& archive, ToolChange& event) {
  visit_origin(archive, event.origin);
  language::visit_all(archive, event.number, event.is_preselection);
  visit_optional(archive, event.offset);
  visit_optional(archive, event.shape);
}
template <class Archive>
void visit_event(Archive& archive, Miscellaneous& event) {
  visit_origin(archive, event.origin);
  archive(event.code);
}
template <class Archive>
void visit_event(Archive& archive, Stop& event) {
  visit_origin(archive, event.origin);
  archive(event.kind);
}
template <class Archive>
void visit_event(Archive& archive, UnitsChange& event) {
  visit_origin(archive, event.origin);
  archive(event.units);
}
template <class Archive>
void visit_event(Archive& archive, OverrideInhibit& event) {
  visit_origin(archive, event.origin);
  language::visit_all(archive, event.feed_override, event.spindle_override, event.single_block,
                      event.hold, event.is_tapping);
}
template <class Archive>
void visit_event(Archive& archive, HeldEvents::Text& event) {
  constexpr std::size_t kMaxText = 4096;
  visit_origin(archive, event.origin);
  language::visit_all(archive, event.kind, event.device);
  language::visit_text(archive, event.text, kMaxText);
}
template <class Archive>
void visit_event(Archive& archive, HeldEvents::BlockEnd& event) {
  visit_origin(archive, event.origin);
}

namespace held_detail {

template <std::size_t kIndex = 0>
bool make_event(std::size_t index, HeldEvents::Event& event) {
  if constexpr (kIndex < std::variant_size_v<HeldEvents::Event>) {
    if (index != kIndex) return make_event<kIndex + 1>(index, event);
    event.emplace<kIndex>();
    return true;
  }
  return false;
}

}  // namespace held_detail

template <class Archive>
void visit_held(Archive& archive, HeldEvents& held) {
  std::size_t count = held.size();
  // A few events of the last lines may come on top.
  if (!archive.size(count, 16 * HeldEvents::kMax)) return;
  visit_position(archive, held.start());
  if constexpr (Archive::kReads) held.events().resize(count);
  for (HeldEvents::Event& event : held.events()) {
    auto index = static_cast<std::uint8_t>(event.index());
    archive(index);
    if (Archive::kReads && !held_detail::make_event(index, event)) return archive.damage();
    std::visit([&](auto& each) { visit_event(archive, each); }, event);
  }
  if constexpr (Archive::kReads) {
    if (archive.is_damaged() || held.empty()) return;
    // What is held always begins with a move: corners are made with it.
    const HeldEvents::Event& first = held.events().front();
    const bool is_move = std::holds_alternative<Rapid>(first) ||
                         std::holds_alternative<Line>(first) || std::holds_alternative<Arc>(first);
    if (!is_move) archive.damage();
  }
}

}  // namespace dripline::interpreter::rs274ngc
