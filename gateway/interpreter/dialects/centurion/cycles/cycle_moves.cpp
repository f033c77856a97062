#include "gateway/interpreter/dialects/centurion/cycles/cycle_moves.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

Point machine_point(const Run& run, const Point& at) {
  return {run.state.origin.x + at.x, run.state.origin.z + at.z};
}

/// An axis that does not move is not part of the move, however its coordinate was computed.
AxesNamed moved_axes(const Run& run, Point& to) {
  constexpr double kSame = 1e-9;
  const Point& from = run.state.position;
  if (std::fabs(to.x - from.x) < kSame) to.x = from.x;
  if (std::fabs(to.z - from.z) < kSame) to.z = from.z;
  return {to.x != from.x, to.z != from.z};
}

}  // namespace

Point cycle_position(const Run& run) {
  return {run.state.position.x - run.state.origin.x, run.state.position.z - run.state.origin.z};
}

void cycle_rapid(Run& run, const Point& to) {
  Point target = machine_point(run, to);
  const AxesNamed axes = moved_axes(run, target);
  rapid_to(run, target, axes);
}

void cycle_rapid_to_clearance(Run& run, const Point& to) {
  cycle_rapid(run, to);
  if (run.options.single_block) run.events().on_stop({run.origin, StopKind::Operator});
}

void cycle_feed(Run& run, const Point& to, Feed feed) {
  Point target = machine_point(run, to);
  const AxesNamed axes = moved_axes(run, target);
  feed_to(run, target, axes, feed);
}

void cycle_dwell(Run& run, double seconds) {
  if (seconds == 0) return;
  run.state.dwell_seconds = seconds;
  run.events().on_dwell({run.origin, seconds, {}});
}

bool check_cycle_length(Run& run, double moves) {
  if (moves <= kMaxCycleMoves) return true;
  return run.fail(ErrorCode::CycleTooLong, 0,
                  fmt::format("{:.0f} moves, {:.0f} are possible", moves, kMaxCycleMoves));
}

bool check_cycle_spindle(Run& run) {
  if (run.state.spindle.state != SpindleState::Off) return true;
  switch (run.options.spindle_check) {
    case SpindleCheck::Ignore:
      return true;
    case SpindleCheck::Alarm:
      return run.fail(ErrorCode::SpindleNeeded, 0);
    case SpindleCheck::Warn:
      break;
  }
  run.events().on_warning(
      {run.origin, diagnostic(error_row(ErrorCode::SpindleNeeded), {}, run.origin.line)});
  return true;
}

bool run_canned_cycle(Run& run, bool (*cycle)(Run&)) {
  if (run.parameters[kNoCannedCycles] != 0) {
    return run.fail(ErrorCode::UndefinedCycle, 0,
                    fmt::format("G{}: the canned cycles are not loaded", run.axis_code()));
  }
  cancel_compensation(run);
  const bool is_done = cycle(run);
  resume_compensation(run);
  return is_done;
}

}  // namespace dripline::interpreter::centurion
