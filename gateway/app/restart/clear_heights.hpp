#pragma once

#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

/// What a run has shown of the heights at which its tool can be led across, for each axis that may
/// be the tool's. A height that only feed moves have had is through the part. Value type; all
/// heights are the tip's, in the coordinates of ReachedHeights.
///
/// The highest place of a run is clear if it is above all cuts across and a rapid of the program
/// led across, there or lower; or if it is above the deepest cut, and a rapid of the tool axis
/// alone led out of the cut, as high as the tool went in; or the run began there, and its first
/// move lowered the tool by kLowered or more. A program at one height alone, as of a torch, shows
/// none: beside the part its rapids may be as deep as its cuts. (A block that names where the axes
/// are already moves none, so a program whose first ones do that is not seen to be at its
/// clearance.)
class ClearHeights {
 public:
  enum class Kind { Feed, Rapid, Arc };  ///< Feed and Rapid along a straight line
  struct Move {
    interpreter::Position from, to;  ///< `to` marks the axes of the program
    Kind kind = Kind::Feed;
  };
  void move(const Move& move);

  /// Whether a tip at that height, the highest of the run, can be led across.
  bool is_clear(interpreter::Axis axis, double highest) const;

  static constexpr double kLowered = 10;  ///< millimeters

 private:
  void move_along(interpreter::Axis axis, const Move& move);
  void add_rapid(interpreter::Axis axis, const Move& move, bool is_across);
  void add_feed(interpreter::Axis axis, const Move& move, bool is_across);

  bool has_moved_ = false;
  interpreter::Position crossed_;    ///< marks the axes that a rapid led across
  interpreter::Position retracted_;  ///< the highest end of rapids up
  interpreter::Position begun_;      ///< where the first move lowered the tool from
  interpreter::Position entered_;    ///< the highest of all feed moves
  interpreter::Position deepest_;    ///< the lowest of them
  interpreter::Position cut_;        ///< the highest of those across

  template <class Archive>
  friend void visit(Archive& archive, ClearHeights& heights) {
    archive(heights.has_moved_, heights.crossed_, heights.retracted_, heights.begun_,
            heights.entered_, heights.deepest_, heights.cut_);
  }
};

}  // namespace dripline::gateway
