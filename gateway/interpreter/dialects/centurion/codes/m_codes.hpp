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
  SpindleCounterclockwise,
  SpindleOff,
  ToolChange,
  FloodOn,
  CoolantOff,
  Call,
  // The machine is told these by number; reading pins and waiting is done here.
  PulseAndWait,  ///< M20-M29: X output n pulsed, X output 12 on meanwhile, wait for X input n
  WaitChannel,   ///< M32: wait for Z input 6
  SetOutput,     ///< M60-M69: X output n
  ClearOutput,   ///< M70-M79
  WaitInput,     ///< M80-M89: X input n
};

/// PostMove: what the machine's builder has listed to come last (option `post_m`).
enum class MTiming : std::uint8_t { BeforeMove, AfterMove, PostMove, Flow };

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
