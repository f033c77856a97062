#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/prototrak/receiver.hpp"

/// Blocks to events: the Receiver's second half (spec 8 to 10, 13).
namespace dripline::interpreter::prototrak {
namespace {

bool is_axis(Address address) {
  return address <= Address::YO || (address >= Address::X && address <= Address::K);
}

}  // namespace

XY Receiver::reference() const {
  if (moved_reference_) return *moved_reference_;
  return program_.events.empty() ? XY{} : reference_of(program_, program_.events.size() - 1);
}

bool Receiver::make_event(const BlockWords& block) {
  if (block.has(Address::Z)) z_changed_ = true;
  int event_code = -1;
  bool has_other = false;
  for (const int code : block.g_codes) {
    const bool makes_event = code <= 3 || (code >= 100 && code <= 109);
    if (makes_event && event_code >= 0 && code != event_code) {
      return fail(Fault::UnknownWord,
                  fmt::format("G{:02} and G{:02} in one block", event_code, code));
    }
    if (makes_event) event_code = code;
    has_other |=
        code == 28 || code == 92 || (code >= 43 && code <= 49) || (code >= 80 && code <= 89);
  }
  if (block.has_g(92) || block.has_g(28)) {
    if (block.has_g(92)) {
      XY here = reference();
      double x = here.x, y = here.y;
      if (!dimension(block, Address::X, x) || !dimension(block, Address::Y, y)) return false;
      moved_reference_ = XY{x, y};
    }
    return true;
  }
  if (event_code >= 100) return make_native(block, event_code);
  if (event_code >= 0) return make_converted(block, event_code);
  const bool has_axes = std::any_of(block.words.begin(), block.words.end(),
                                    [](const Word& word) { return is_axis(word.address); });
  const bool is_excused = has_other || !block.g_codes.empty();
  if (has_axes && !is_excused) return fail(Fault::NoFunction, block_);
  return true;
}

/// G00 to G03 (spec 13): Z decides whether cuts are connected.
bool Receiver::make_converted(const BlockWords& block, int code) {
  const bool moves = block.has(Address::X) || block.has(Address::Y);
  const bool is_circle = code >= 2 && (block.has(Address::I) || block.has(Address::J));
  if (!moves && !is_circle) return true;
  ProgramEvent event;
  event.is_converted = true;
  const XY from = reference();
  event.begin = from;
  if (!coordinate(block, Address::XB, from.x, event.begin.x) ||
      !coordinate(block, Address::YB, from.y, event.begin.y)) {
    return false;
  }
  XY to = event.begin;
  if (!coordinate(block, Address::X, from.x, to.x) ||
      !coordinate(block, Address::Y, from.y, to.y)) {
    return false;
  }
  event.end = to;
  if (code == 0) {
    event.begin = to;
    return store(event);
  }
  event.kind = code == 1 ? EventKind::Mill : EventKind::Arc;
  event.is_counter_clockwise = code == 3;
  if (code >= 2 && !fill_arc_center(block, event)) return false;
  if (!program_.events.empty()) {
    ProgramEvent& last = program_.events.back();
    if (last.is_converted && last.is_cut() && !z_changed_) last.is_connected = true;
  }
  return store(event);
}

bool Receiver::make_native(const BlockWords& block, int code) {
  ProgramEvent event;
  bool is_good = false;
  switch (code) {
    case 100: {
      event.kind = EventKind::Position;
      event.begin = reference();
      is_good = coordinate(block, Address::X, event.begin.x, event.begin.x) &&
                coordinate(block, Address::Y, event.begin.y, event.begin.y) &&
                (block.has(Address::X) || require(block, {Address::Y}));
      event.end = event.begin;
      break;
    }
    case 101:
      event.kind = EventKind::Mill;
      is_good = (block.has(Address::XE) || require(block, {Address::YE})) && fill_cut(block, event);
      break;
    case 102:
    case 103:
      event.kind = EventKind::Arc;
      event.is_counter_clockwise = code == 103;
      is_good = fill_cut(block, event) && fill_arc_center(block, event);
      break;
    case 104:
      event.kind = EventKind::BoltHole;
      is_good = fill_circle(block, event);
      break;
    case 105:
      event.kind = EventKind::Repeat;
      is_good = fill_repeat(block, event);
      break;
    case 106:
    case 107:
      event.kind = code == 106 ? EventKind::RectangularPocket : EventKind::RectangularFrame;
      is_good = fill_rectangle(block, event);
      break;
    default:
      event.kind = code == 108 ? EventKind::CircularPocket : EventKind::CircularFrame;
      is_good = fill_circle(block, event);
  }
  return is_good && store(event);
}

bool Receiver::fill_cut(const BlockWords& block, ProgramEvent& event) {
  event.begin = reference();
  if (!coordinate(block, Address::XB, event.begin.x, event.begin.x) ||
      !coordinate(block, Address::YB, event.begin.y, event.begin.y)) {
    return false;
  }
  event.end = event.begin;
  return coordinate(block, Address::XE, event.begin.x, event.end.x) &&
         coordinate(block, Address::YE, event.begin.y, event.end.y) && fill_conrad(block, event);
}

/// XC and YC count from the end point when incremental, I and J always from the begin point.
bool Receiver::fill_arc_center(const BlockWords& block, ProgramEvent& event) {
  const bool has_center = block.has(Address::XC) || block.has(Address::YC);
  const bool has_distance = block.has(Address::I) || block.has(Address::J);
  if (!has_center && !has_distance) return require(block, {Address::XC});
  if (has_center && has_distance) notice(Fault::Noticed, "XC and YC count, I and J do not");
  double i = 0, j = 0;
  if (!dimension(block, Address::I, i) || !dimension(block, Address::J, j)) return false;
  event.center = {event.begin.x + i, event.begin.y + j};
  if (has_center) {
    event.center = {};
    if (modal_.is_incremental) event.center = event.end;
    if (!coordinate(block, Address::XC, event.end.x, event.center.x) ||
        !coordinate(block, Address::YC, event.end.y, event.center.y)) {
      return false;
    }
  }
  const double first = std::hypot(event.begin.x - event.center.x, event.begin.y - event.center.y);
  event.radius = first;
  return true;
}

bool Receiver::fill_conrad(const BlockWords& block, ProgramEvent& event) {
  event.is_connected = true;
  const Word* word = block.find(Address::CR);
  if (word == nullptr) return true;
  event.is_connected = !word->number.is_negative;
  double value = 0;
  if (!dimension(block, Address::CR, value)) return false;
  event.conrad = event.is_connected ? value : 0;
  return true;
}

bool Receiver::fill_repeat(const BlockWords& block, ProgramEvent& event) {
  const auto previous = static_cast<std::int64_t>(program_.events.size());
  std::int64_t from = previous, to = previous, passes = 0, tool = 0;
  if (!require(block, {Address::RE}) || !integer(block, Address::FE, 1, 255, from) ||
      !integer(block, Address::LE, 1, 255, to) || !integer(block, Address::RE, 1, 99, passes) ||
      !integer(block, Address::T, 1, 99, tool) || !dimension(block, Address::XO, event.end.x) ||
      !dimension(block, Address::YO, event.end.y) || !size(block, Address::D, 0, event.diameter)) {
    return false;
  }
  event.from_event = static_cast<std::uint8_t>(from);
  event.to_event = static_cast<std::uint8_t>(to);
  event.passes = static_cast<std::uint8_t>(passes);
  event.has_tool = block.has(Address::T);
  event.has_diameter = block.has(Address::D);
  if (event.has_tool) event.tool = static_cast<std::uint8_t>(tool);
  return true;
}

bool Receiver::fill_rectangle(const BlockWords& block, ProgramEvent& event) {
  using enum Address;
  const XY from = reference();
  std::int64_t direction = 1;
  if (!require(block, {XB, YB, XD, YD}) || !coordinate(block, XB, from.x, event.begin.x) ||
      !coordinate(block, YB, from.y, event.begin.y) ||
      !coordinate(block, XD, event.begin.x, event.end.x) ||
      !coordinate(block, YD, event.begin.y, event.end.y) || !size(block, FC, 0, event.finish_cut) ||
      !integer(block, DR, 1, 2, direction) || !fill_conrad(block, event)) {
    return false;
  }
  if (!event.is_connected) notice(Fault::Noticed, "a negative conrad is taken as 0");
  event.is_connected = false;
  event.is_counter_clockwise = direction == 2;
  return true;
}

bool Receiver::fill_circle(const BlockWords& block, ProgramEvent& event) {
  using enum Address;
  const XY from = reference();
  std::int64_t direction = 1, holes = 0;
  const double least = modal_.is_metric ? 0.01 : 0.0005 * Length::kMillimetresPerInch;
  if (!require(block, {XC, YC, R}) || !coordinate(block, XC, from.x, event.begin.x) ||
      !coordinate(block, YC, from.y, event.begin.y) || !size(block, R, least, event.radius) ||
      !size(block, FC, 0, event.finish_cut) || !integer(block, DR, 1, 2, direction) ||
      !integer(block, HL, 1, 999, holes)) {
    return false;
  }
  if (event.kind == EventKind::BoltHole && !require(block, {HL})) return false;
  if (const Word* angle = block.find(A)) event.angle = angle->number.value(3);
  event.holes = static_cast<std::uint16_t>(holes);
  event.is_counter_clockwise = direction == 2;
  return true;
}

bool Receiver::store(ProgramEvent event) {
  if (program_.events.size() >= kMaxEvents) {
    return fail(Fault::MemoryFull, fmt::format("more than {} events", kMaxEvents));
  }
  const double default_feed = modal_.is_metric ? 25.0 : Length::kMillimetresPerInch;
  event.is_metric = modal_.is_metric;
  event.feed = modal_.has_feed ? modal_.feed : default_feed;
  event.side = modal_.side;
  if (event.kind != EventKind::Repeat) {
    event.diameter = modal_.diameter;
    event.tool = modal_.tool;
  }
  event.line = block_line_;
  event.offset = block_offset_;
  event.sequence = sequence_;
  if (!has_units_ && program_.events.empty()) program_.is_metric = modal_.is_metric;
  const bool is_pocket =
      event.kind == EventKind::CircularPocket || event.kind == EventKind::RectangularPocket;
  const ToolSide inside = event.is_counter_clockwise ? ToolSide::Left : ToolSide::Right;
  if (is_pocket && event.side != ToolSide::Center && event.side != inside) {
    notice(Fault::SideContradicts, "");
  }
  program_.events.push_back(event);
  moved_reference_.reset();
  z_changed_ = false;
  return true;
}

XY reference_of(const StoredProgram& program, std::size_t index) {
  for (std::size_t depth = 0; depth <= program.events.size(); ++depth) {
    const ProgramEvent& event = program.events[index];
    if (event.is_cut()) return event.end;
    if (event.kind != EventKind::Repeat) return event.begin;
    if (event.from_event < 2 || event.from_event > index + 1) return {};
    index = event.from_event - 2U;
  }
  return {};
}

}  // namespace dripline::interpreter::prototrak
