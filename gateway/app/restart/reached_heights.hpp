#pragma once

#include <optional>

#include "gateway/app/restart/clear_heights.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/tool_lengths.hpp"

namespace dripline::gateway {

/// How high the axes of a mill and the tip of its tool have been in a run, so that an approach
/// finds a place above all that the run went over. Value type.
///
/// The axes are at the program's position + the lengths of the tool, where a machine adds them; a
/// place that they have had is within their travel. The tip's places say how high another tool has
/// to be over the same part.
struct ReachedHeights {
  /// Of the tool, while a move is given.
  struct Lengths {
    machine::ToolLengths of_axes{};  ///< as the axes take them in: none in machine coordinates
    machine::ToolLengths of_tool{};
    bool shifts_position = false;  ///< Dialect::length_shifts_position
  };

  using Kind = ClearHeights::Kind;  ///< of a move

  interpreter::Position at;        ///< of the program
  machine::ToolLengths lengths{};  ///< taken in by the axes
  interpreter::Position axes;      ///< the greatest coordinate of each axis of the machine
  interpreter::Position tip;       ///< likewise of the tip, of the axes that the program has moved
  ClearHeights clear;

  /// The run begins with the axes at `begin_at` + `begin_lengths`. They have been there, too.
  void begin(const interpreter::Position& begin_at, const machine::ToolLengths& begin_lengths);
  void move(const interpreter::Position& to, const Lengths& now) { move(to, now, Kind::Feed); }
  void move(const interpreter::Position& to, const Lengths& now, Kind kind);
  void move(const interpreter::Position& to, const interpreter::PathArc& arc, const Lengths& now);

  /// The greatest coordinate of a tool with these lengths, as the program counts it. Nothing: not
  /// known.
  std::optional<double> highest(interpreter::Axis axis, const Lengths& tool) const;
  /// Whether such a tool can be led across at `height`, the highest of the run.
  bool is_clear(interpreter::Axis axis, double height, const Lengths& tool) const;

 private:
  void raise(interpreter::Axis axis, double value, const Lengths& now);
  interpreter::Position tip_at(const Lengths& now) const;
};

/// 0 along an axis that has none.
double along(const machine::ToolLengths& lengths, interpreter::Axis axis);

/// For the state archive.
template <class Archive>
void visit(Archive& archive, ReachedHeights& heights) {
  archive(heights.at, heights.lengths, heights.axes, heights.tip, heights.clear);
}

}  // namespace dripline::gateway
