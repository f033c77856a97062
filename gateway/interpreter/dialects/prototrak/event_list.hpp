#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter::prototrak {

// What the control stores (manual: events): numbered events instead of blocks.

enum class EventKind : std::uint8_t {
  Position,
  Mill,
  Arc,
  BoltHole,
  Repeat,
  RectangularPocket,
  RectangularFrame,
  CircularPocket,
  CircularFrame,
};

enum class ToolSide : std::uint8_t { Center, Right, Left };  ///< TC 0, 1, 2

struct XY {
  double x = 0, y = 0;
};

/// One event. Lengths are millimeters whatever its unit, feeds mm per minute, all absolute.
struct ProgramEvent {
  EventKind kind = EventKind::Position;
  bool is_metric = false;
  bool is_counterclockwise = false;  ///< arcs; pockets and frames: DR2
  bool is_connected = false;         ///< CR is not negative
  XY begin;   ///< position; begin of mill and arc; center of bolt hole and circles; first corner
  XY end;     ///< of mill and arc; opposite corner of rectangles; offsets of a repeat
  XY center;  ///< of an arc
  double radius = 0;      ///< R
  double conrad = 0;      ///< CR, when not negative
  double angle = 0;       ///< A, degrees
  double diameter = 0;    ///< D
  double finish_cut = 0;  ///< FC
  double feed = 0;        ///< F
  ToolSide side = ToolSide::Center;
  std::uint8_t tool = 1;
  std::uint16_t holes = 0;                                ///< HL
  std::uint8_t from_event = 0, to_event = 0, passes = 0;  ///< FE, LE, RE
  bool has_diameter = false, has_tool = false;            ///< given in a repeat: overrides
  bool is_converted = false;                              ///< made of G00 to G03
  // Its place in the program.
  std::uint64_t offset = 0, line = 0;
  std::int64_t sequence = -1;

  /// A length in the event's own unit, for people.
  double shown(double mm) const { return is_metric ? mm : mm / Length::kMillimetersPerInch; }
  bool is_cut() const { return kind == EventKind::Mill || kind == EventKind::Arc; }
};

inline constexpr std::size_t kMaxEvents = 255;

/// A received program.
struct StoredProgram {
  std::vector<ProgramEvent> events;  ///< number 1 first
  std::uint32_t part_number = 0;
  bool has_part_number = false;
  bool is_metric = false;  ///< the unit it began with
};

/// The place the next event's increments count from (manual: absolute and incremental).
XY reference_of(const StoredProgram& program, std::size_t index);

/// The stored program as the control sends it: one event a line in its own event format, every
/// coordinate absolute, numbers with their point. Receiving it gives the same events.
std::string list_events(const StoredProgram& program);

// What can be wrong with a program. The control has no error texts; ids and texts are decided
// here.

// The rows are named as enumerators are, because they are used as such.
// NOLINTBEGIN(readability-identifier-naming): a row is named as an enumerator would be
struct Fault {
  static constexpr DiagnosticRow NoBlockEnd{"PTK0102", "no end of block"};
  static constexpr DiagnosticRow Character{"PTK0103", "invalid character"};
  static constexpr DiagnosticRow Range{"PTK0104", "value out of range"};
  static constexpr DiagnosticRow NoNumber{"PTK0105", "address without number"};
  static constexpr DiagnosticRow MemoryFull{"PTK0106", "memory full"};
  static constexpr DiagnosticRow NoFunction{"PTK0107", "axis words without motion or event code"};
  static constexpr DiagnosticRow MissingWord{"PTK0108", "required word is missing"};
  static constexpr DiagnosticRow UnknownWord{"PTK0109", "unknown word"};
  static constexpr DiagnosticRow NoEnd{"PTK0110", "end of data without %"};
  static constexpr DiagnosticRow TextFailed{"PTK0111", "program text cannot be read"};
  static constexpr DiagnosticRow NotText{
      "PTK0112",
      "no program text, as a file in which an MX or later control stores events in its own form is "
      "(.MX2, .MX3, .PT4): that form is not published; give the program in the maker's CAM text "
      "form"};
  static constexpr DiagnosticRow NoStartEvent{"PTK0113", "the program has no such event"};
  static constexpr DiagnosticRow StartInChain{
      "PTK0114", "a start here would lose how the events of its chain are joined"};
  static constexpr DiagnosticRow ArcRadii{"PTK0201", "radii at begin and end of the arc differ"};
  static constexpr DiagnosticRow RepeatRange{"PTK0202", "bad repeat range"};
  static constexpr DiagnosticRow Join{"PTK0203", "conrad or offset join is impossible"};
  static constexpr DiagnosticRow ToolDoesNotFit{"PTK0204", "tool does not fit"};
  static constexpr DiagnosticRow LoopLimit{"PTK0205", "repeats go on without end"};
  static constexpr DiagnosticRow NotConnectable{"PTK0301", "next event cannot be connected"};
  static constexpr DiagnosticRow Ignored{"PTK0302", "ignored"};
  static constexpr DiagnosticRow SideContradicts{"PTK0303", "tool side contradicts the pocket"};
  static constexpr DiagnosticRow Noticed{"PTK0304", "taken as it is"};
};
// NOLINTEND(readability-identifier-naming)

}  // namespace dripline::interpreter::prototrak
