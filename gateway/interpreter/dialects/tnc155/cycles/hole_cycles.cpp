#include <cmath>

#include "gateway/interpreter/core/override_inhibit.hpp"
#include "gateway/interpreter/dialects/tnc155/cycles/cycle_motion.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// How far in front of the last depth the rapid infeed ends: 0.6 mm, of holes deeper than 30 mm a
/// fiftieth, 7 mm at most.
double stop_distance(double depth) {
  constexpr double kShallow = 30, kLeast = 0.6, kMax = 7, kPart = 50;
  const double deep = std::fabs(depth);
  return deep <= kShallow ? kLeast : std::min(deep / kPart, kMax);
}

SpindleState reversed(SpindleState state) {
  return state == SpindleState::Clockwise ? SpindleState::Counterclockwise
                                          : SpindleState::Clockwise;
}

}  // namespace

void drill_by_pecks(CycleMotion& motion, const MachiningCycle& cycle) {
  const double toward = cycle.depth < 0 ? -1 : 1;
  const double surface = motion.start_height() + cycle.clearance;
  const double bottom = surface + cycle.depth;
  const double stop = stop_distance(cycle.depth);
  double depth = surface;
  for (int peck = 0; toward * (bottom - depth) > 0; ++peck) {
    if (peck > 0) {
      motion.rapid_to_height(motion.start_height());
      const double before = depth - toward * stop;
      const bool is_above_start = toward * (before - motion.start_height()) < 0;
      motion.rapid_to_height(is_above_start ? motion.start_height() : before);
    }
    depth += cycle.peck;
    if (toward * (depth - bottom) >= 0) depth = bottom;
    motion.feed_to_height(depth, cycle.feed);
  }
  motion.dwell(cycle.dwell);
  motion.rapid_to_height(motion.start_height());
}

void tap(Run& run, CycleMotion& motion, const MachiningCycle& cycle) {
  const SpindleState direction = run.state.spindle.state;
  run.events().on_override_inhibit(tapping_lock(run.origin));
  motion.feed_to_height(motion.start_height() + cycle.clearance + cycle.depth, cycle.feed);
  turn_spindle(run, reversed(direction));
  motion.dwell(cycle.dwell);
  motion.feed_to_height(motion.start_height(), cycle.feed);
  turn_spindle(run, direction);
  run.events().on_override_inhibit({.origin = run.origin});
}

}  // namespace dripline::interpreter::tnc155
