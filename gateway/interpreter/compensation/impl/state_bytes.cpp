#include "gateway/interpreter/compensation/impl/state_bytes.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

namespace dripline::interpreter::compensation::impl {
namespace {

/// One list of members serves both ways: `visit(archive, value)`.
class Writer {
 public:
  explicit Writer(std::vector<std::byte>& bytes) : out(bytes) {}
  template <class T>
  void value(T& number) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&number);
    out.insert(out.end(), bytes, bytes + sizeof number);
  }
  std::vector<std::byte>& out;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : in(bytes) {}
  template <class T>
  void value(T& number) {
    is_damaged |= in.size() - at < sizeof number;
    if (is_damaged) return;
    if constexpr (std::is_same_v<T, bool>) {
      is_damaged |= std::to_integer<int>(in[at]) > 1;
      number = std::to_integer<int>(in[at]) == 1;
    } else {
      std::memcpy(&number, in.data() + at, sizeof number);
    }
    if constexpr (std::is_floating_point_v<T>) is_damaged |= !std::isfinite(number);
    at += sizeof number;
  }
  std::span<const std::byte> in;
  std::size_t at = 0;
  bool is_damaged = false;
};

template <class Archive>
void fail(Archive& archive) {
  if constexpr (std::is_same_v<Archive, Reader>) archive.is_damaged = true;
}
template <class Archive>
bool is_sound(const Archive& archive) {
  if constexpr (std::is_same_v<Archive, Reader>) return !archive.is_damaged;
  return true;
}

template <class Archive, class... Numbers>
requires(std::is_arithmetic_v<Numbers>&&...) void all(Archive& archive, Numbers&... numbers) {
  (archive.value(numbers), ...);
}

template <class Archive, class Enum>
void up_to(Archive& archive, Enum& value, Enum last) {
  auto number = static_cast<std::uint8_t>(value);
  archive.value(number);
  if (number > static_cast<std::uint8_t>(last)) return fail(archive);
  value = static_cast<Enum>(number);
}

template <class Archive>
void visit(Archive& archive, PlaneVector& vector) {
  all(archive, vector.first, vector.second);
}
template <class Archive>
void visit(Archive& archive, Length& length) {
  double mm = length.mm();
  archive.value(mm);
  length = Length::mm(mm);
}
template <class Archive>
void visit(Archive& archive, Origin& origin) {
  all(archive, origin.block, origin.offset, origin.line, origin.sequence, origin.program);
}
template <class Archive>
void visit(Archive& archive, Position& position) {
  for (const Axis axis : kAllAxes) {
    bool has = position.has(axis);
    double value = position.raw(axis);
    all(archive, has, value);
    position.set_raw(axis, value);
    if (!has) position.unmark(axis);
  }
}
template <class Archive>
void visit(Archive& archive, Feed& feed) {
  Feed::Per per = feed.per();
  up_to(archive, per, Feed::Per::Move);
  double number = per == Feed::Per::Move ? feed.moves_per_minute() : feed.length().mm();
  archive.value(number);
  if (per == Feed::Per::Minute) feed = Feed::per_minute(Length::mm(number));
  if (per == Feed::Per::Revolution) feed = Feed::per_revolution(Length::mm(number));
  if (per == Feed::Per::Move) feed = Feed::inverse_time(number);
}
template <class Archive>
void visit(Archive& archive, double& number) {
  archive.value(number);
}
template <class Archive, class Value>
void visit_optional(Archive& archive, std::optional<Value>& optional) {
  bool has = optional.has_value();
  archive.value(has);
  if (!has) return optional.reset();
  if (!optional) optional.emplace();
  visit(archive, *optional);
}
template <class Archive>
void visit(Archive& archive, OutsideCorner& corner) {
  up_to(archive, corner, OutsideCorner::IntersectCurves);
}

template <class Archive>
void visit(Archive& archive, LeadIn& lead_in) {
  all(archive, lead_in.count);
  if (lead_in.count > lead_in.pieces.size()) lead_in.count = 0, fail(archive);
  for (std::uint8_t i = 0; i < lead_in.count; ++i) {
    Piece& piece = lead_in.pieces[i];
    all(archive, piece.is_arc, piece.sweep);
    visit(archive, piece.to);
    visit(archive, piece.center);
  }
}
template <class Archive>
void visit(Archive& archive, Element& element) {
  all(archive, element.is_rapid, element.is_arc, element.offset);
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
  all(archive, arch.radius_in, arch.radius_out, arch.side, arch.sweep);
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
  archive.value(event.seconds);
  visit_optional(archive, event.revolutions);
}
template <class Archive>
void visit(Archive& archive, Spindle& event) {
  visit(archive, event.origin);
  up_to(archive, event.state, SpindleState::Oriented);
  archive.value(event.revolutions_per_minute);
  visit_optional(archive, event.surface_speed);
  visit_optional(archive, event.max_revolutions);
}
template <class Archive>
void visit(Archive& archive, Coolant& event) {
  visit(archive, event.origin);
  all(archive, event.flood, event.mist);
}
template <class Archive>
void visit(Archive& archive, ToolChange& event) {
  visit(archive, event.origin);
  bool has_offset = event.offset.has_value();
  int offset = event.offset.value_or(0);
  all(archive, event.number, event.is_preselection, has_offset, offset);
  event.offset = has_offset ? std::optional(offset) : std::nullopt;
}
template <class Archive>
void visit(Archive& archive, Miscellaneous& event) {
  visit(archive, event.origin);
  archive.value(event.code);
}
template <class Archive>
void visit(Archive& archive, PinChange& event) {
  visit(archive, event.origin);
  up_to(archive, event.axis, Axis::W);
  all(archive, event.output, event.state);
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

void write_text(Writer& archive, HeldText& text, std::string_view content) {
  up_to(archive, text.kind, HeldText::Kind::Message);
  up_to(archive, text.device, OutputDevice::Printer);
  visit(archive, text.origin);
  archive.value(text.size);
  for (char c : content) archive.value(c);
}

void write_held(Writer& archive, const HeldEvents& held) {
  auto count = static_cast<std::uint8_t>(held.size());
  archive.value(count);
  for (std::size_t i = 0; i < held.size(); ++i) {
    HeldEvent event = held[i];
    auto kind = static_cast<std::uint8_t>(event.index());
    archive.value(kind);
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

void read_text(Reader& archive, HeldEvents& held) {
  HeldText text;
  up_to(archive, text.kind, HeldText::Kind::Message);
  up_to(archive, text.device, OutputDevice::Printer);
  visit(archive, text.origin);
  archive.value(text.size);
  if (archive.is_damaged || text.size > kMaxHeldText || archive.in.size() - archive.at < text.size)
    return fail(archive);
  const auto* content = reinterpret_cast<const char*>(archive.in.data()) + archive.at;
  if (!held.push(text, {content, text.size})) fail(archive);
  archive.at += text.size;
}

template <class Event>
void read_event(Reader& archive, HeldEvents& held) {
  if constexpr (std::is_same_v<Event, HeldText>) {
    read_text(archive, held);
  } else {
    Event event{};
    visit(archive, event);
    if (!archive.is_damaged && !held.push(event)) fail(archive);
  }
}

template <std::size_t... Kinds>
void read_kind(Reader& archive, HeldEvents& held, std::size_t kind, std::index_sequence<Kinds...>) {
  const bool is_known =
      ((kind == Kinds
            ? (read_event<std::variant_alternative_t<Kinds, HeldEvent>>(archive, held), true)
            : false) ||
       ...);
  if (!is_known) fail(archive);
}

void read_held(Reader& archive, HeldEvents& held) {
  std::uint8_t count = 0;
  archive.value(count);
  held.clear();
  for (std::uint8_t i = 0; i < count && !archive.is_damaged; ++i) {
    std::uint8_t kind = 0;
    archive.value(kind);
    read_kind(archive, held, kind, std::make_index_sequence<std::variant_size_v<HeldEvent>>{});
  }
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  up_to(archive, state.phase, Phase::Parallel);
  all(archive, state.has_element, state.is_displaced, state.offset, state.idle_blocks);
  up_to(archive, state.plane, Plane::YZ);
  visit(archive, state.tip);
  up_to(archive, state.start_up, StartUp::Tangent);
  visit_optional(archive, state.next_corner);
  visit(archive, state.programmed);
  visit(archive, state.tool);
  if (state.has_element && is_sound(archive)) visit(archive, state.element);
}

}  // namespace

void append_bytes(const State& state, std::vector<std::byte>& out) {
  Writer archive(out);
  State copy = state;
  visit_state(archive, copy);
  write_held(archive, state.held);
}

Result<std::size_t> read_bytes(State& state, std::span<const std::byte> bytes) {
  Reader archive(bytes);
  State read;
  visit_state(archive, read);
  read_held(archive, read.held);
  if (archive.is_damaged) {
    return dripline::fail(Errc::Corrupt, "compensation state of {} bytes does not read back",
                          bytes.size());
  }
  state = read;
  return archive.at;
}

}  // namespace dripline::interpreter::compensation::impl
