#pragma once

#include <cstdint>
#include <vector>

#include "protocol/base/units.hpp"

/// What the control stores (manual: events): numbered events instead of blocks.
namespace dripline::interpreter::prototrak {

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

}  // namespace dripline::interpreter::prototrak
