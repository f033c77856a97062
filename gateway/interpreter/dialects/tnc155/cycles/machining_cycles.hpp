#pragma once

#include "gateway/interpreter/dialects/tnc155/cycles/cycle_motion.hpp"

/// The motion of each machining cycle, from the position of the tool. A cycle that cannot be cut
/// was refused before (`check_machining`).
namespace dripline::interpreter::tnc155 {

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
