#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/impl/executor.hpp"

/// The part of the executor that the operator acts on: hold, overrides, handwheel, and where the
/// program inhibits them.
namespace dripline::machine::impl {

using interpreter::FeedHoldInhibit;

namespace {

/// The longest travel of the handwheel that waits: no operator is further ahead of a machine.
constexpr double kMaxHandwheelSeconds = 600;
constexpr std::string_view kTapByHandwheel =
    "tapping cycles are not done in handwheel mode: this one is left out";

}  // namespace

double Executor::advance(double by, std::size_t max_actions) {
  if (is_jogging_ || !is_driven_by_hand()) return pass(by, max_actions);
  const double used = pass(std::min(by, handwheel_seconds_), max_actions);
  handwheel_seconds_ = std::max(0.0, handwheel_seconds_ - used);
  // Travel of the handwheel while nothing can move is dropped.
  if (!motion_.is_active() && !is_dwelling_ && !may_start()) handwheel_seconds_ = 0;
  return used;
}

/// A move that slows down, and a tap, are executed in the machine's own time.
bool Executor::is_driven_by_hand() const {
  return panel_.handwheel && !is_held_ && !is_aborting_ && (!lock_.is_tapping || skips_tap_);
}

bool Executor::rests_by_hand() const {
  return is_driven_by_hand() && handwheel_seconds_ == 0;
}

/// From here on the machine's own time passes. Where the handwheel rests, so do the axes: the
/// program's speed at this place is none of theirs, so nothing brakes or is executed to its end.
void Executor::leave_handwheel() {
  if (!is_jogging_ && rests_by_hand()) {
    if (motion_.is_active()) motion_.rest();
    speed_ = 0;
  }
  handwheel_seconds_ = 0;
}

/// During a hold or an abort it moves nothing, later neither.
void Executor::turn_handwheel(double seconds) {
  if (!panel_.handwheel || is_over() || is_held_ || is_aborting_) return;
  handwheel_seconds_ = std::clamp(handwheel_seconds_ + seconds, 0.0, kMaxHandwheelSeconds);
}

bool Executor::is_moving() const {
  if (is_jogging_) return true;
  return speed() > 0 && !rests_by_hand();
}

/// During a requested hold: whether an action under `lock` is executed nevertheless.
bool Executor::delays_hold(const Lock& lock) const {
  return hold_waits_ && lock.hold != FeedHoldInhibit::AtOnce;
}

bool Executor::must_rest(const Lock& lock) const {
  if (is_aborting_ || (is_held_ && !delays_hold(lock))) return true;
  return lacks_records_ && lock.hold == FeedHoldInhibit::AtOnce;
}

/// Of the move in which the axes come to rest until its records are written.
void Executor::ask_for_records() {
  if (!lacks_records_ || !motion_.is_active() || !sink_.on_motion_starts(origin_)) return;
  lacks_records_ = false;
  plan_motion_again();
}

void Executor::enter(const Action& action) {
  const Lock& lock = action.lock;
  const bool is_same_tap =
      lock.is_tapping && lock_.is_tapping && action.origin.block == origin_.block;
  origin_ = action.origin;
  lock_ = lock;
  if (lock.hold == FeedHoldInhibit::AtOnce) hold_waits_ = false;
  // Too fast to come to rest before it.
  if (lock.hold == FeedHoldInhibit::Later && is_held_ && speed_ > 0) hold_waits_ = true;
  if (is_same_tap) return;
  skips_tap_ = lock.is_tapping && panel_.handwheel;
  if (skips_tap_) sink_.on_message({origin_, kTapByHandwheel});
}

/// A tapping cycle ends where it began, so without its moves the path continues from there.
bool Executor::skips(const Action& action) const {
  return skips_tap_ &&
         (std::holds_alternative<Move>(action.body) || std::holds_alternative<Wait>(action.body) ||
          std::holds_alternative<interpreter::Spindle>(action.body));
}

/// Only a move that an operator can interrupt obeys a hold; an abort stops everything.
MotionGoal Executor::goal(const Move& move) const {
  if (is_jogging_)
    return {.cruise = is_jog_stopping_ ? 0 : std::min(move.ceiling, move.speed), .exit = 0};
  if (must_rest(lock_)) return {.cruise = 0, .exit = 0};
  return {.cruise = move.wanted_speed(lock_.seen(panel_)), .exit = std::sqrt(move.exit_square)};
}

void Executor::set_panel(const OperatorPanel& panel) {
  const OperatorPanel next = panel.clamped();
  if (next == panel_) return;
  const bool is_pressed = next.emergency_stop && !panel_.emergency_stop;
  if (panel_.handwheel && (is_pressed || !next.handwheel)) leave_handwheel();
  panel_ = next;
  if (is_jogging_ && (panel_.emergency_stop || panel_.feed_override == 0)) stop_jog();
  if (is_pressed) press_emergency_stop();
  if (panel_.dry_run && !panel_.dry_run_spindle && spindle_.is_turning()) {
    withheld_spindle_ = spindle_.programmed();
    stop_spindle();
  }
  planner_.invalidate();
  plan_motion_again();
  if (may_discard() && speed() == 0) discard();
}

void Executor::stop_spindle() {
  if (!spindle_.is_turning()) return;
  spindle_.stop();
  interpreter::Spindle off;
  off.origin = origin_;
  sink_.on_spindle(off);
}

/// The dry run is over: as the program has it, before anything moves.
void Executor::return_spindle() {
  if (!withheld_spindle_ || (panel_.dry_run && !panel_.dry_run_spindle) || is_emergency_) return;
  interpreter::Spindle spindle = *std::exchange(withheld_spindle_, std::nullopt);
  spindle.origin = origin_;
  spindle_.set(spindle);
  sink_.on_spindle(spindle);
}

/// Also for a program that is over: its spindle may still turn.
void Executor::press_emergency_stop() {
  withheld_spindle_.reset();
  stop_spindle();
  if (shown_.flood || shown_.mist) {
    shown_.flood = shown_.mist = false;
    sink_.on_coolant({origin_, false, false});
  }
  if (!is_over()) is_emergency_ = is_aborting_ = true;
}

void Executor::hold() {
  if (is_jogging_) return stop_jog();
  if (is_held_ || is_over()) return;
  const bool rests = rests_by_hand();
  leave_handwheel();
  is_held_ = true;
  hold_waits_ = lock_.hold == FeedHoldInhibit::Later && !rests;
  plan_motion_again();
}

bool Executor::resume() {
  if (is_aborting_ || is_over()) return false;
  if (!is_held_ && stop_ == MachineState::Idle) return false;
  is_held_ = hold_waits_ = false;
  stop_ = MachineState::Idle;
  return_spindle();
  plan_motion_again();
  return true;
}

void Executor::abort() {
  if (is_jogging_) return stop_jog();
  if (is_aborting_ || is_over()) return;
  leave_handwheel();
  is_aborting_ = true;
  if (speed() > 0)
    plan_motion_again();
  else
    discard();
}

}  // namespace dripline::machine::impl
