#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/prototrak/contour.hpp"
#include "gateway/interpreter/dialects/prototrak/receiver.hpp"

/// Blocks to events: the Receiver's second half (manual: events and their words).
namespace dripline::interpreter::prototrak {
namespace {

using enum Address;

using AddressSet = language::WordLedger::Words;
static_assert(kAddressCount <= 64);
constexpr AddressSet set_of(Address address) {
  return AddressSet{1} << static_cast<unsigned>(address);
}
constexpr AddressSet set_of(std::initializer_list<Address> addresses) {
  AddressSet set = 0;
  for (const Address address : addresses) set |= set_of(address);
  return set;
}

/// Coordinates. Z and K never move anything here, I and J belong to arcs.
constexpr AddressSet kMovingWords = set_of({XB, YB, XE, YE, XC, YC, XD, YD, XO, YO, X, Y});
/// Words of one event alone (README, "Decided here").
constexpr AddressSet kEventWords = set_of({CR, FC, DR, HL, A, R, RE, FE, LE});

constexpr bool makes_event(int code) {
  return code <= 3 || (code >= 100 && code <= 109);
}
/// It only sets what other words mean (Receiver::apply_modes).
constexpr bool is_mode(int code) {
  return code == 20 || code == 21 || (code >= 40 && code <= 42) || code == 90 || code == 91;
}

}  // namespace

XY Receiver::reference() const {
  if (moved_reference_) return *moved_reference_;
  return program_.events.empty() ? XY{} : reference_of(program_, program_.events.size() - 1);
}

bool Receiver::make_event(const BlockWords& block) {
  AddressSet present = 0;
  for (const Word& word : block.words) present |= set_of(word.address);
  ledger_.open(present & (kMovingWords | kEventWords | set_of({Z, I, J, K})));
  if (block.has(Z)) z_changed_ = true;
  std::optional<int> event_code;
  bool is_ignored = false;
  for (const int code : block.g_codes) {
    is_ignored |= !makes_event(code) && !is_mode(code);
    if (!makes_event(code)) continue;
    // the second one, the same or another, is that of an event whose ';' is missing before it
    if (event_code) {
      return fail(Fault::UnknownWord,
                  fmt::format("G{:02} and G{:02} in one block", *event_code, code));
    }
    event_code = code;
  }
  if (block.has_g(92) || block.has_g(28)) return !block.has_g(92) || move_reference(block);
  // an ignored code takes its words with it (manual: modified Fanuc 6 programs)
  if (!event_code && is_ignored) return true;
  const bool is_native = event_code.value_or(0) >= 100;
  if (!is_native && !block.g_codes.empty()) ledger_.take(set_of(Z));
  if (event_code) {
    const bool is_made =
        is_native ? make_native(block, *event_code) : make_converted(block, *event_code);
    if (!is_made) return false;
  }
  return ledger_.left() == 0 || report_left_words(block, event_code);
}

bool Receiver::move_reference(const BlockWords& block) {
  XY here = reference();
  if (!dimension(block, X, here.x) || !dimension(block, Y, here.y)) return false;
  moved_reference_ = here;
  return true;
}

/// A coordinate that nothing takes would be missing on the part.
bool Receiver::report_left_words(const BlockWords& block, std::optional<int> event_code) {
  const AddressSet left = ledger_.left();
  const std::string words =
      language::listed(left, [](std::size_t i) { return std::string(kAddressNames[i]); });
  if (event_code && (left & kMovingWords) != 0)
    return fail(Fault::UnknownWord, fmt::format("{} in G{:02}", words, *event_code));
  if ((left & kMovingWords) != 0 || (block.g_codes.empty() && (left & ~kEventWords) != 0))
    return fail(Fault::NoFunction, block_);
  notice(Fault::Ignored, words);
  return true;
}

/// G00 to G03 (manual: modified Fanuc 6 programs): Z decides whether cuts are connected, unless a
/// conrad says so.
bool Receiver::make_converted(const BlockWords& block, int code) {
  if ((block.has(X) && block.has(XE)) || (block.has(Y) && block.has(YE)))
    return fail(Fault::UnknownWord, "two end points in one block");
  const bool ends = block.has(X) || block.has(Y) || block.has(XE) || block.has(YE);
  const bool begins = block.has(XB) || block.has(YB);
  const bool is_circle =
      code >= 2 && (block.has(I) || block.has(J) || block.has(XC) || block.has(YC));
  if (!ends && !is_circle) return !begins || fail(Fault::MissingWord, "an end point");
  ProgramEvent event;
  event.is_converted = true;
  const XY from = reference();
  event.begin = from;
  if (code == 0) {
    if (!coordinate(block, X, from.x, event.begin.x) ||
        !coordinate(block, Y, from.y, event.begin.y)) {
      return false;
    }
    event.end = event.begin;
    return store(event);
  }
  if (!coordinate(block, XB, from.x, event.begin.x) ||
      !coordinate(block, YB, from.y, event.begin.y)) {
    return false;
  }
  event.end = event.begin;
  if (!coordinate(block, X, from.x, event.end.x) || !coordinate(block, Y, from.y, event.end.y) ||
      !coordinate(block, XE, event.begin.x, event.end.x) ||
      !coordinate(block, YE, event.begin.y, event.end.y)) {
    return false;
  }
  event.kind = code == 1 ? EventKind::Mill : EventKind::Arc;
  event.is_counterclockwise = code == 3;
  if (code >= 2 && !fill_arc_center(block, event)) return false;
  connect_previous(event);
  if (block.has(CR) && !fill_conrad(block, event)) return false;
  if (!store(event)) return false;
  z_decides_ = !block.has(CR);
  return true;
}

/// The cut before this one, where both came from a Fanuc program.
void Receiver::connect_previous(const ProgramEvent& event) {
  if (program_.events.empty()) return;
  ProgramEvent& last = program_.events.back();
  if (!last.is_converted || !last.is_cut()) return;
  if (z_changed_) last.is_connected = false;
  if (z_decides_ && !z_changed_)
    last.is_connected = distance(last.end, event.begin) <= join_tolerance(last.is_metric);
}

bool Receiver::make_native(const BlockWords& block, int code) {
  ProgramEvent event;
  bool is_good = false;
  switch (code) {
    case 100: {
      event.kind = EventKind::Position;
      event.begin = reference();
      is_good = coordinate(block, X, event.begin.x, event.begin.x) &&
                coordinate(block, Y, event.begin.y, event.begin.y) &&
                (block.has(X) || require(block, {Y}));
      event.end = event.begin;
      break;
    }
    case 101:
      event.kind = EventKind::Mill;
      is_good = (block.has(XE) || require(block, {YE})) && fill_cut(block, event);
      break;
    case 102:
    case 103:
      event.kind = EventKind::Arc;
      event.is_counterclockwise = code == 103;
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
  if (!coordinate(block, XB, event.begin.x, event.begin.x) ||
      !coordinate(block, YB, event.begin.y, event.begin.y)) {
    return false;
  }
  event.end = event.begin;
  return coordinate(block, XE, event.begin.x, event.end.x) &&
         coordinate(block, YE, event.begin.y, event.end.y) && fill_conrad(block, event);
}

/// XC and YC count from the end point when incremental, I and J always from the begin point.
bool Receiver::fill_arc_center(const BlockWords& block, ProgramEvent& event) {
  const bool has_center = block.has(XC) || block.has(YC);
  const bool has_distance = block.has(I) || block.has(J);
  if (!has_center && !has_distance) {
    return fail(Fault::MissingWord,
                block.has(R) ? "XC YC or I J: the control takes no R for an arc" : "XC YC or I J");
  }
  if (has_center && !require(block, {XC, YC})) return false;
  if (has_center && has_distance) notice(Fault::Noticed, "XC and YC count, I and J do not");
  double i = 0, j = 0;
  if (!dimension(block, I, i) || !dimension(block, J, j)) return false;
  event.center = {event.begin.x + i, event.begin.y + j};
  if (has_center) {
    event.center = {};
    if (modal_.is_incremental) event.center = event.end;
    if (!coordinate(block, XC, event.end.x, event.center.x) ||
        !coordinate(block, YC, event.end.y, event.center.y)) {
      return false;
    }
  }
  const double first = std::hypot(event.begin.x - event.center.x, event.begin.y - event.center.y);
  event.radius = first;
  return true;
}

bool Receiver::fill_conrad(const BlockWords& block, ProgramEvent& event) {
  event.is_connected = true;
  const Word* word = block.find(CR);
  if (word == nullptr) return true;
  event.is_connected = !word->number.is_negative;
  double value = 0;
  if (!dimension(block, CR, value)) return false;
  event.conrad = event.is_connected ? value : 0;
  return true;
}

bool Receiver::fill_repeat(const BlockWords& block, ProgramEvent& event) {
  const auto previous = static_cast<std::int64_t>(program_.events.size());
  std::int64_t from = previous, to = previous, passes = 0, tool = 0;
  if (!require(block, {RE}) || !integer(block, FE, 1, 255, from) ||
      !integer(block, LE, 1, 255, to) || !integer(block, RE, 1, 99, passes) ||
      !integer(block, T, 1, 99, tool) || !dimension(block, XO, event.end.x) ||
      !dimension(block, YO, event.end.y) || !size(block, D, 0, event.diameter)) {
    return false;
  }
  event.from_event = static_cast<std::uint8_t>(from);
  event.to_event = static_cast<std::uint8_t>(to);
  event.passes = static_cast<std::uint8_t>(passes);
  event.has_tool = block.has(T);
  event.has_diameter = block.has(D);
  if (event.has_tool) event.tool = static_cast<std::uint8_t>(tool);
  return true;
}

bool Receiver::fill_rectangle(const BlockWords& block, ProgramEvent& event) {
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
  event.is_counterclockwise = direction == 2;
  return true;
}

bool Receiver::fill_circle(const BlockWords& block, ProgramEvent& event) {
  const XY from = reference();
  std::int64_t direction = 1, holes = 0;
  const double least = modal_.is_metric ? 0.01 : 0.0005 * Length::kMillimetersPerInch;
  if (!require(block, {XC, YC, R}) || !coordinate(block, XC, from.x, event.begin.x) ||
      !coordinate(block, YC, from.y, event.begin.y) || !size(block, R, least, event.radius) ||
      !size(block, FC, 0, event.finish_cut) || !integer(block, DR, 1, 2, direction) ||
      !integer(block, HL, 1, 999, holes)) {
    return false;
  }
  if (event.kind == EventKind::BoltHole && !require(block, {HL})) return false;
  if (const Word* angle = block.find(A)) {
    event.angle = angle->number.value(3);
    take(A);
  }
  event.holes = static_cast<std::uint16_t>(holes);
  event.is_counterclockwise = direction == 2;
  return true;
}

bool Receiver::store(ProgramEvent event) {
  if (program_.events.size() >= kMaxEvents) {
    return fail(Fault::MemoryFull, fmt::format("more than {} events", kMaxEvents));
  }
  const double default_feed = modal_.is_metric ? 25.0 : Length::kMillimetersPerInch;
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
  const ToolSide inside = event.is_counterclockwise ? ToolSide::Left : ToolSide::Right;
  if (is_pocket && event.side != ToolSide::Center && event.side != inside) {
    notice(Fault::SideContradicts, "");
  }
  if (event.kind == EventKind::Mill && distance(event.begin, event.end) == 0) {
    notice(Fault::Noticed, "the cut ends where it begins");
  }
  program_.events.push_back(event);
  moved_reference_.reset();
  z_changed_ = false;
  z_decides_ = false;
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
