#include "gateway/interpreter/dialects/tektronix1704/motion.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::interpreter::tektronix1704 {
namespace {

/// Counts from R when dimensions are incremental, and stays.
void load_depth(Run& run) {
  State& state = run.state;
  const Words& words = state.block.words;
  if (!words.has(Address::Z)) return;
  state.depth = (state.is_incremental ? state.clearance : 0) + words[Address::Z];
  state.has_depth = true;
}

/// Below R the tool leaves the hole first; above it, it comes down over the hole.
bool position_tool(Run& run) {
  const State& state = run.state;
  Counts hole = end_point(run);
  const bool has_level = state.has_clearance && run.options.axes == kAxes;
  const std::int64_t level = has_level ? state.clearance : state.program[kZ];
  Counts up = state.program;
  up[kZ] = level;
  if (state.program[kZ] < level && !move_line(run, {up, Pace::Rapid})) return false;
  hole[kZ] = run.options.cycle_z_moves_with_xy ? level : state.program[kZ];
  if (!move_line(run, {hole, Pace::Rapid})) return false;
  hole[kZ] = level;
  return move_line(run, {hole, Pace::Rapid});
}

void set_spindle(Run& run, SpindleState to) {
  Spindle event;
  event.origin = run.origin;
  event.state = to;
  if (to != SpindleState::Off && run.options.has_spindle_speed) {
    event.revolutions_per_minute =
        run.options.spindle_speed[static_cast<std::size_t>(run.state.spindle_code)];
  }
  run.events().on_spindle(event);
}

SpindleState reverse_of(SpindleState direction) {
  return direction == SpindleState::Counterclockwise ? SpindleState::Clockwise
                                                     : SpindleState::Counterclockwise;
}

/// Feeds until the timer fires, out to R, back to the same depth, and so on (manual: G83).
bool peck(Run& run) {
  const State& state = run.state;
  const auto feed = feed_rate(run);
  if (!feed) return false;
  const auto bottom = static_cast<double>(state.depth);
  const double step = *feed / run.mm_per_count * run.options.peck_seconds / 60;
  constexpr double kMaxPecks = 10'000;
  const auto clearance = static_cast<double>(state.clearance);
  if (bottom > clearance) {
    return run.fail(Fault::PeckUpward, 0, fmt::format("Z{}, R{}", state.depth, state.clearance));
  }
  if (step * kMaxPecks < clearance - bottom) {
    return run.fail(Fault::FeedOutOfRange, 0, "more than 10000 pecks");
  }
  for (double at = clearance; at > bottom;) {
    const double next = std::max(at - step, bottom);
    if (at < clearance &&
        (!move_depth(run, clearance, Pace::Rapid) || !move_depth(run, at, Pace::Rapid))) {
      return false;
    }
    if (!move_depth(run, next, Pace::Feed)) return false;
    at = next;
  }
  return true;
}

bool do_step(Run& run, CycleStep step) {
  const auto depth = static_cast<double>(run.state.depth);
  const auto clearance = static_cast<double>(run.state.clearance);
  switch (step) {
    case CycleStep::FeedIn:
      return move_depth(run, depth, Pace::Feed);
    case CycleStep::PeckIn:
      return peck(run);
    case CycleStep::Dwell:
      run.events().on_dwell({run.origin, run.options.dwell_seconds, std::nullopt});
      return true;
    case CycleStep::SpindleStop:
      set_spindle(run, SpindleState::Off);
      return true;
    case CycleStep::SpindleReverse:
      set_spindle(run, reverse_of(run.state.spindle));
      return true;
    case CycleStep::ProgramStop:
      run.events().on_stop({run.origin, StopKind::Program});
      return true;
    case CycleStep::FeedOut:
      return move_depth(run, clearance, Pace::Feed);
    case CycleStep::RapidOut:
    case CycleStep::ManualOut:
      return move_depth(run, clearance, Pace::Rapid);
  }
  return true;
}

bool changes_spindle(CycleStep step) {
  return step == CycleStep::SpindleStop || step == CycleStep::SpindleReverse;
}

bool work_hole(Run& run) {
  const CycleSteps& steps = run.options.cycles[static_cast<std::size_t>(run.state.cycle - 80)];
  for (const CycleStep step : steps) {
    if (!do_step(run, step)) return false;
  }
  if (std::any_of(steps.begin(), steps.end(), changes_spindle)) {
    set_spindle(run, run.state.spindle);
  }
  return true;
}

}  // namespace

void load_clearance(Run& run) {
  State& state = run.state;
  const bool is_incremental = state.is_incremental;
  state.clearance = (is_incremental ? state.program[kZ] : 0) + state.block.words[Address::R];
  state.has_clearance = true;
}

bool run_cycle(Run& run) {
  State& state = run.state;
  constexpr std::uint16_t kStarts = kEndWords | bit(Address::R);
  if (!state.block.words.has_any(kStarts)) return true;
  load_depth(run);
  run.ledger.take(kEndWords);
  const bool only_positions = state.cycle == 80;
  if (!only_positions && !state.has_clearance) return run.fail(Fault::NoClearance);
  if (!only_positions && !state.has_depth) return run.fail(Fault::NoDepth);
  if (!only_positions) {
    Counts bottom = end_point(run);
    bottom[kZ] = state.depth;
    if (!check_point(run, bottom)) return false;
  }
  if (!position_tool(run)) return false;
  return only_positions || work_hole(run);
}

}  // namespace dripline::interpreter::tektronix1704
