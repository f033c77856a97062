#pragma once

#include <cstdint>
#include <string_view>

/// The miscellaneous functions of this control (spec 12.1). A number without a row goes to the
/// machine as it is, before the move.
namespace dripline::interpreter::centurion {

enum class MAction : std::uint8_t {
  Strobe,  ///< handed to the machine by number
  ProgramStop,
  OptionalStop,
  End,
  EndAllOff,     ///< M30: spindle and coolant off too
  SpindleRange,  ///< M41 to M43
  SpindleClockwise,
  SpindleCounterClockwise,
  SpindleOff,
  ToolChange,
  FloodOn,
  CoolantOff,
  Call,
};

enum class MTiming : std::uint8_t { BeforeMove, AfterMove, Flow };

struct MRow {
  std::uint8_t code;
  MAction action;
  MTiming timing;
  std::string_view name;
};

inline constexpr unsigned kHighestM = 99;
/// Also for numbers the table does not name: a strobe before the move.
const MRow& m_row(unsigned code);

}  // namespace dripline::interpreter::centurion
