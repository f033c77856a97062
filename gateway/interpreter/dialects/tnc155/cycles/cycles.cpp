#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"

#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/tnc155/cycles/cycle_motion.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/flow.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

bool check_signs(Run& run, const MachiningCycle& cycle) {
  const double toward = cycle.depth;
  const bool has_pecks = cycle.number != kTapping;
  const bool good =
      toward != 0 && cycle.clearance * toward >= 0 && (!has_pecks || cycle.peck * toward > 0);
  if (good) return true;
  const std::string pecking = has_pecks ? fmt::format(", PECKING {}", cycle.peck) : "";
  return run.fail(ErrorCode::WrongSign,
                  fmt::format("SET-UP {}, DEPTH {}{}: none may be 0 or of another sign",
                              cycle.clearance, cycle.depth, pecking));
}

bool check_feeds(Run& run, const MachiningCycle& cycle) {
  const bool plunges = cycle.number >= kSlot;
  if (cycle.feed > 0 && (!plunges || cycle.plunge_feed > 0)) return true;
  return run.fail(ErrorCode::FeedRateMissing, fmt::format("in CYCL DEF {}", cycle.number));
}

bool too_narrow(Run& run, std::string_view what, double size) {
  return run.fail(
      ErrorCode::ToolRadiusTooLarge,
      fmt::format("{} {}, tool radius {}", what, shown_length(Length::mm(size), run.state.units),
                  shown_number(Length::mm(run.state.tool.data.radius), run.state.units)));
}

/// The sides along the two axes of the plane, each one of them.
bool check_sides(Run& run, const MachiningCycle& cycle) {
  const PlaneAxes axes = axes_of(run.state.plane);
  const auto is_in_plane = [&](Axis axis) { return axis == axes.first || axis == axes.second; };
  if (is_in_plane(cycle.first_axis) && is_in_plane(cycle.second_axis) &&
      cycle.first_axis != cycle.second_axis) {
    return true;
  }
  return run.fail(
      ErrorCode::PlaneWronglyDefined,
      fmt::format("sides along {} and {}", letter(cycle.first_axis), letter(cycle.second_axis)));
}

bool check_room(Run& run, const MachiningCycle& cycle) {
  const double width =
      2 * run.state.tool.data.radius / run.state.transformation.factor(run.state.plane);
  if (!(width > 0)) return too_narrow(run, "no tool to mill", 0);
  if (cycle.number == kCircularPocket) {
    return 2 * cycle.radius > width || too_narrow(run, "circle radius", cycle.radius);
  }
  if (!check_sides(run, cycle)) return false;
  for (const double side : {std::fabs(cycle.first_side), std::fabs(cycle.second_side)}) {
    if (!(side > width)) return too_narrow(run, "side", side);
  }
  return true;
}

double stepover(const Run& run) {
  return run.options.pocket_overlap * run.state.tool.data.radius /
         run.state.transformation.factor(run.state.plane);
}

/// They wait with the block that leads to the corner; other events need room too.
constexpr double kMaxAtCorner = look_ahead::kMaxHeldEvents - 16;

/// How many moves a call comes to, about.
double moves_of(const Run& run, const MachiningCycle& cycle) {
  if (cycle.number == kTapping) return 2;
  const double pecks = pecks_of(cycle);
  if (cycle.number == kPecking) return 3 * pecks;
  if (cycle.number == kSlot) return 2 * pecks;
  const double widest =
      cycle.number == kCircularPocket
          ? cycle.radius
          : std::min(std::fabs(cycle.first_side), std::fabs(cycle.second_side)) / 2;
  return pecks * (4 + 6 * std::ceil(widest / stepover(run)));
}

bool check_bounds(Run& run, const MachiningCycle& cycle) {
  const double moves = moves_of(run, cycle);
  const bool waits = cycle.number < kSlot && run.state.is_compensating();
  if (waits && moves > kMaxAtCorner) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("a hole at a corner of a contour would be {:.0f} moves, at most "
                                "{:.0f}; R0 before it",
                                moves, kMaxAtCorner));
  }
  if (moves <= kMaxMoves) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("a call of CYCL DEF {} would be {:.0f} moves, at most {:.0f}",
                              cycle.number, moves, kMaxMoves));
}

void make(Run& run, CycleMotion& motion, const MachiningCycle& cycle) {
  switch (cycle.number) {
    case kPecking:
      drill_by_pecks(motion, cycle);
      break;
    case kTapping:
      tap(run, motion, cycle);
      break;
    case kSlot:
      mill_slot(motion, cycle);
      break;
    case kPocket:
      mill_pocket(motion, cycle, stepover(run));
      break;
    default:
      mill_circle(motion, cycle, stepover(run));
      break;
  }
}

/// A cycle that does not keep to the limits is not begun.
bool stays_within_limits(Run& run, CycleMotion& motion, const MachiningCycle& cycle) {
  if (!run.limits.has_any() || run.tilted.is_on()) return true;
  const Position machine = run.state.machine;
  const auto nominal = run.state.nominal;
  run.is_measuring = true;
  if (cycle.number < kSlot) {
    motion.feed_to_height(motion.start_height() + cycle.clearance + cycle.depth, cycle.feed);
  } else {
    make(run, motion, cycle);
  }
  run.is_measuring = false;
  run.state.machine = machine;
  run.state.nominal = nominal;
  return !run.limits.reached();
}

bool run_machining(Run& run, const MachiningCycle& cycle) {
  using Direction = CycleMotion::Direction;
  CycleMotion motion(run,
                     cycle.number < kSlot ? Direction::AlongTheToolAxis : Direction::InThePlane);
  if (!stays_within_limits(run, motion, cycle)) return run.fail_at_limit();
  make(run, motion, cycle);
  motion.end();
  return true;
}

}  // namespace

bool check_machining(Run& run, const MachiningCycle& cycle) {
  const State& state = run.state;
  if (!state.tool.is_called || !state.spindle.has_speed) {
    return run.fail(ErrorCode::ToolCallMissing, "a cycle needs TOOL CALL with axis and S");
  }
  if (state.spindle.state == SpindleState::Off) {
    return run.fail(ErrorCode::SpindleRotatesMissing, "M03 or M04 before a cycle");
  }
  if (!check_signs(run, cycle) || !check_feeds(run, cycle)) return false;
  if (cycle.number == kCircularPocket && !check_circle_plane(run)) return false;
  if (cycle.number >= kSlot && !check_room(run, cycle)) return false;
  return check_bounds(run, cycle);
}

bool call_cycle(Run& run) {
  const MachiningCycle& cycle = run.state.cycle.machining;
  if (cycle.number == 0) return run.fail(ErrorCode::CycleIncomplete, "no cycle was defined");
  if (cycle.number == kProgramCall) return call_cycle_program(run, cycle.program);
  if (cycle.number >= itnc::kFirstTable) return itnc::run_table(run);
  if (!refuse_before_positioning(run, "a cycle call")) return false;
  if (!itnc::check_tilted_cycle(run, "a cycle") || !check_machining(run, cycle)) return false;
  return run_machining(run, cycle);
}

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
