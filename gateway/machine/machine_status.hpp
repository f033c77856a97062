#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/tool_lengths.hpp"

namespace dripline::machine {

using Seconds = std::chrono::duration<double>;

enum class MachineState : std::uint8_t {
  Idle,           ///< everything queued is done: before a program, starved, or before an answer
  Running,        ///< moving, dwelling, or about to
  Held,           ///< feed hold: slowing down or at standstill
  ProgramStop,    ///< M0, an operator stop, or a tool change that waits; `resume` continues
  OptionalStop,   ///< M1 with its switch on
  SingleBlock,    ///< at standstill between two blocks
  Completed,      ///< the end of the program was executed
  Alarmed,        ///< only `begin` leaves it
  Aborted,        ///< only `begin` leaves it
  EmergencyStop,  ///< braking or at standstill; Aborted at standstill with the switch released
};

enum class MotionKind : std::uint8_t { None, Rapid, Line, Clockwise, Counterclockwise, Thread };

struct MachineStatus {
  MachineState state = MachineState::Idle;
  interpreter::Position position;  ///< actual
  /// What `position` and `target` leave out: an axis is at position + length. None where `begin`
  /// places the axes.
  ToolLengths lengths{};
  interpreter::Position target;        ///< where the present move ends; at rest: the position
  double feed_per_minute = 0;          ///< actual speed along the path, mm or degrees
  double spindle_rpm = 0;              ///< actual; negative: counterclockwise
  interpreter::Origin origin;          ///< of the block being executed, or the last one
  std::uint64_t executed = 0;          ///< Origin::block of the last block executed
  Seconds buffered{0};                 ///< of queued motion and dwells, at 100 % override
  std::size_t queued = 0;              ///< actions waiting
  interpreter::StopKind stopped_at{};  ///< in ProgramStop
  MotionKind motion{};                 ///< of the present move, or the last one
  bool is_tapping = false;             ///< that is one of a tapping cycle, to the bottom or back
  bool is_feed_limited = false;        ///< the move is slower than feed and override ask for
  Seconds dwell_left{0};
  std::optional<int> tool, next_tool, tool_offset;  ///< as far as programs have named them
  interpreter::Spindle spindle;                     ///< as programmed
  bool flood = false, mist = false;

  /// Where the axes are.
  interpreter::Position axes() const { return plus(position, lengths); }
};

}  // namespace dripline::machine
