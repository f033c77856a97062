#pragma once

#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"

namespace dripline::interpreter::tnc155 {

/// The moves of one call of a machining cycle, from the position of the tool. Program coordinates:
/// transformations of the program apply to the cycle too. `u` and `v` are the plane's axes.
class CycleMotion {
 public:
  /// A hole is made at the corner that the contour has there. A pocket is milled where the block
  /// before ends by itself; the contour resumes at `end`.
  enum class Direction : std::uint8_t { AlongTheToolAxis, InThePlane };

  CycleMotion(Run& run, Direction direction);
  void end();

  PlaneVector start() const { return start_; }
  double start_height() const { return start_height_; }
  /// In program coordinates: scaling makes it differ from the tool's own radius.
  double tool_radius() const { return tool_radius_; }
  /// The direction for the machine: mirroring does not reverse a cycle.
  Turn turn_for(Turn programmed) const;
  /// The place of an axis in the plane: 0, 1, or -1 for neither.
  int place_of(Axis axis) const;

  void feed_to_height(double height, double feed);
  void rapid_to_height(double height);
  void feed_to(PlaneVector to, double feed);
  void rapid_to(PlaneVector to);
  void arc_to(PlaneVector to, PlaneVector center, Turn turn, double feed);
  void circle(PlaneVector center, Turn turn, double feed);
  void dwell(double seconds);

 private:
  void move(Axis axis, double value, Pace pace);
  void move(PlaneVector to, Pace pace);

  Run& run_;
  bool leaves_contour_;
  PlaneAxes axes_;
  Position machine_;    ///< before compensation
  AxisValues nominal_;  ///< as the program left it
  AxisValues beside_;
  bool is_beside_;
  PlaneVector start_;
  double start_height_ = 0;
  double tool_radius_ = 0;
};

// The motion of each machining cycle, from the position of the tool. A cycle that cannot be cut
// was refused before (`check_machining`).

/// A call is one block, and the number of moves in one block is bounded.
inline constexpr double kMaxMoves = 8000;

/// Conditions of a call: tool, spindle, signs, sizes, bounds.
bool check_machining(Run& run, const MachiningCycle& cycle);

void drill_by_pecks(CycleMotion& motion, const MachiningCycle& cycle);
void tap(Run& run, CycleMotion& motion, const MachiningCycle& cycle);
void mill_slot(CycleMotion& motion, const MachiningCycle& cycle);
/// `step`: sideways from pass to pass, at most.
void mill_pocket(CycleMotion& motion, const MachiningCycle& cycle, double step);
void mill_circle(CycleMotion& motion, const MachiningCycle& cycle, double step);

/// Depths one below the other, the last one the cycle's own.
inline double pecks_of(const MachiningCycle& cycle) {
  return std::ceil(std::fabs(cycle.depth / cycle.peck) - 1e-9);
}

}  // namespace dripline::interpreter::tnc155
