#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gateway/machine/tool_lengths.hpp"

namespace dripline::machine {

/// Which lengths of a tool the axes of a real machine have taken in, move by move: they go to the
/// program's position + length. Where it is not certain whether an axis of the control would move
/// by a length, there is no move. Pure.
class AxisLengths {
 public:
  /// `shifts`: a length that comes into force changes the program's position, and no axis moves;
  /// else the position stays, and an axis follows with its own next move.
  explicit AxisLengths(bool shifts) : shifts_(shifts) {}

  /// The axes are at `at` + `lengths`.
  void begin(const interpreter::Position& at, const ToolLengths& lengths);
  /// The program is at `at` without a move: a probe has ended there.
  void note_position(const interpreter::Position& at) { last_ = at; }
  /// `modes` as they are in `block`, the one that the interpreter executes.
  void note(const interpreter::ActiveModes& modes, std::uint64_t block);

  struct Move {
    const interpreter::Position& to;
    std::uint64_t block = 0;  ///< whose move it is: compensation gives it later
    bool is_arc = false;
  };
  /// After `note`: takes the move, with `lengths`; or why not.
  std::optional<std::string> take(const Move& move);
  /// Of the move taken last.
  const ToolLengths& lengths() const { return taken_; }
  /// For a block without a move.
  const ToolLengths& shift() {
    if (shifts_) taken_ = wanted_;
    return taken_;
  }

 private:
  const bool shifts_;
  ToolLengths wanted_{}, taken_{};
  std::uint64_t changed_in_ = 0;  ///< block of the last change of `wanted_`
  interpreter::Position last_;    ///< of the program
};

}  // namespace dripline::machine
