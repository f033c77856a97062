#pragma once

#include <array>
#include <bitset>
#include <deque>
#include <optional>
#include <string>

#include "gateway/app/restart/event_tracker.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/machine/tool_lengths.hpp"

namespace dripline::gateway {

using machine::ToolLengths;
/// "X 10, Z 25.4 mm"; empty: there is none. A diameter where `is_lathe`.
std::string to_text(const ToolLengths& lengths, bool is_lathe);

/// How the reported position relates to the axes. A position leaves the length of the tool out: an
/// axis is at position + length. So a length may only be set, and a position only be taken for that
/// of another tool, where it is known which length the position leaves out.
struct ToolInPosition {
  ToolLengths in_force{};  ///< at the control
  /// Of the position. Where a length shifts the position at once (Dialect), the shift shows with
  /// the axis' next move: up to then it is the former one.
  ToolLengths left_out{};
  std::bitset<3> unknown;  ///< of these axes it is not known, until a program begins at its start
  /// MDI has begun without this tool, and no tool was called since.
  ToolLengths dropped{};

  /// Why it cannot be computed where this axis is; empty: at position + `left_out`.
  std::string length_fault(interpreter::Axis axis) const;
  /// Why the position of this axis is no datum, which is that of the tool that the operator has
  /// touched with; empty: it is one.
  std::string datum_fault(interpreter::Axis axis, bool is_lathe) const;

  /// The axes stay, and no tool is in force any more: from here on the position is that of the
  /// axes.
  void drop_tool(interpreter::Position& position);
};

/// The same over the blocks of a run, of which the machine executes one while others are
/// interpreted already. One thread.
class ToolHistory {
 public:
  explicit ToolHistory(bool length_shifts_position) : shifts_(length_shifts_position) {}

  /// `before` is how the position relates to the axes when the run begins, with these modes;
  /// nothing: the axes are at the start of the program.
  void begin(const std::optional<ToolInPosition>& before, const interpreter::ActiveModes& modes);
  /// After each block, or a part of it; `moves` are those since the last call.
  void note(std::uint64_t block, const interpreter::ActiveModes& modes,
            const EventTracker::Moves& moves);
  /// The blocks before the one that is executed are over.
  void drop(std::uint64_t executing);
  /// The machine rests in `block`, which was cut off; nothing: all blocks were executed.
  ToolInPosition at_end(const std::optional<std::uint64_t>& block) const;

 private:
  struct Entry {
    std::uint64_t block = 0;  ///< the first that runs under it
    ToolLengths in_force{}, left_out_before{};
    bool is_plain = true;
    bool is_at_beginning = false;  ///< the axes have not moved: a length in force shows later
    /// The first block that has moved X, Y, Z under it is one of these; 0: none.
    std::array<EventTracker::Moves::Blocks, 3> moved{};
  };
  ToolLengths left_out(const Entry& entry, std::uint64_t block) const;
  void attribute(std::size_t axis, EventTracker::Moves::Blocks blocks);

  bool shifts_;
  ToolInPosition begun_;
  std::deque<Entry> entries_;
  std::optional<std::uint64_t> tool_called_;  ///< the first block that has
};

}  // namespace dripline::gateway
