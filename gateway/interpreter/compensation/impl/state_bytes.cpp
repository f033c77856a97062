#include "gateway/interpreter/compensation/impl/state_bytes.hpp"

#include <cmath>
#include <type_traits>
#include <utility>

#include "gateway/interpreter/language/state_archive.hpp"

namespace dripline::interpreter::compensation::impl {
namespace {

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
void visit(Archive& archive, OutsideCorner& corner) {
  up_to(archive, corner, OutsideCorner::IntersectCurves);
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
void visit(Archive& archive, LeadIn& lead_in) {
  visit_all(archive, lead_in.count);
  if (lead_in.count > lead_in.pieces.size()) lead_in.count = 0, fail(archive);
  for (std::uint8_t i = 0; i < lead_in.count; ++i) {
    Piece& piece = lead_in.pieces[i];
    archive(piece.is_arc);
    visit(archive, piece.sweep);
    visit(archive, piece.to);
    visit(archive, piece.center);
  }
}
template <class Archive>
void visit(Archive& archive, Element& element) {
  visit_all(archive, element.is_rapid, element.is_arc);
  visit(archive, element.offset);
  up_to(archive, element.role, Role::Parallel);
  up_to(archive, element.start_up, StartUp::Tangent);
  visit(archive, element.outside);
  visit(archive, element.origin);
  visit(archive, element.to);
  visit(archive, element.feed);
  for (PlaneVector* vector : {&element.from, &element.end, &element.direction_in,
                              &element.direction_out, &element.arch.center, &element.begin}) {
    visit(archive, *vector);
  }
  Arch& arch = element.arch;
  visit_numbers(archive, arch.radius_in, arch.radius_out, arch.side, arch.sweep);
  visit(archive, element.lead_in);
}

template <class Archive>
void visit(Archive& archive, BlockEnd& event) {
  visit(archive, event.origin);
}
template <class Archive>
void visit(Archive& archive, Rapid& event) {
  visit(archive, event.origin);
  visit(archive, event.to);
}
template <class Archive>
void visit(Archive& archive, Line& event) {
  visit(archive, event.origin);
  visit(archive, event.to);
  visit(archive, event.feed);
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

void write_text(StateWriter& archive, HeldText& text, std::string_view content) {
  up_to(archive, text.kind, HeldText::Kind::Message);
  up_to(archive, text.device, OutputDevice::Printer);
  visit(archive, text.origin);
  archive(text.size);
  for (char c : content) archive(c);
}

void write_held(StateWriter& archive, const HeldEvents& held) {
  auto count = static_cast<std::uint8_t>(held.size());
  archive(count);
  for (std::size_t i = 0; i < held.size(); ++i) {
    HeldEvent event = held[i];
    auto kind = static_cast<std::uint8_t>(event.index());
    archive(kind);
    if (auto* text = std::get_if<HeldText>(&event)) {
      write_text(archive, *text, held.text(*text));
      continue;
    }
    std::visit(
        [&](auto& one) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(one)>, HeldText>) visit(archive, one);
        },
        event);
  }
}

void read_text(StateReader& archive, HeldEvents& held) {
  HeldText text;
  up_to(archive, text.kind, HeldText::Kind::Message);
  up_to(archive, text.device, OutputDevice::Printer);
  visit(archive, text.origin);
  archive(text.size);
  if (text.size > kMaxHeldText) fail(archive);
  std::array<char, kMaxHeldText> content;
  for (std::uint32_t i = 0; i < text.size && !archive.is_damaged(); ++i) archive(content[i]);
  if (!archive.is_damaged() && !held.push(text, {content.data(), text.size})) fail(archive);
}

template <class Event>
void read_event(StateReader& archive, HeldEvents& held) {
  if constexpr (std::is_same_v<Event, HeldText>) {
    read_text(archive, held);
  } else {
    Event event{};
    visit(archive, event);
    if (!archive.is_damaged() && !held.push(event)) fail(archive);
  }
}

template <std::size_t... Kinds>
void read_kind(StateReader& archive, HeldEvents& held, std::size_t kind,
               std::index_sequence<Kinds...>) {
  const bool is_known =
      ((kind == Kinds
            ? (read_event<std::variant_alternative_t<Kinds, HeldEvent>>(archive, held), true)
            : false) ||
       ...);
  if (!is_known) fail(archive);
}

void read_held(StateReader& archive, HeldEvents& held) {
  std::uint8_t count = 0;
  archive(count);
  held.clear();
  for (std::uint8_t i = 0; i < count && !archive.is_damaged(); ++i) {
    std::uint8_t kind = 0;
    archive(kind);
    read_kind(archive, held, kind, std::make_index_sequence<std::variant_size_v<HeldEvent>>{});
  }
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  up_to(archive, state.phase, Phase::Parallel);
  visit_all(archive, state.has_element, state.is_displaced, state.idle_blocks);
  visit(archive, state.offset);
  up_to(archive, state.plane, Plane::YZ);
  visit(archive, state.tip);
  up_to(archive, state.start_up, StartUp::Tangent);
  visit_optional(archive, state.next_corner);
  visit(archive, state.programmed);
  visit(archive, state.tool);
  if (state.has_element) visit(archive, state.waiting());
}

}  // namespace

std::vector<std::byte> to_bytes(const State& state) {
  StateWriter archive;
  State copy = state;
  visit_state(archive, copy);
  write_held(archive, state.held);
  return archive.take();
}

Result<void> from_bytes(State& state, const std::vector<std::byte>& bytes) {
  StateReader archive(bytes);
  State read;
  visit_state(archive, read);
  read_held(archive, read.held);
  if (!archive.is_complete()) {
    return dripline::fail(Errc::Corrupt, "compensation state of {} bytes does not read back",
                          bytes.size());
  }
  state = read;
  return {};
}

}  // namespace dripline::interpreter::compensation::impl
