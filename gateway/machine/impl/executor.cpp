#include "gateway/machine/impl/executor.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::machine::impl {

Executor::Executor(const Parts& parts)
    : limits_(parts.limits),
      workpiece_(parts.workpiece),
      queue_(parts.queue),
      queue_builder_(parts.queue_builder),
      sink_(parts.sink),
      spindle_(parts.limits.spindle) {}

void Executor::begin(const interpreter::Position& at) {
  is_held_ = is_aborting_ = hold_waits_ = skips_tap_ = is_jogging_ = lacks_records_ = false;
  lock_ = {};
  handwheel_seconds_ = 0;
  discard();
  at_ = {};
  axes_ = {};
  for (std::size_t i = 0; i < interpreter::kAxisCount; ++i)
    if (limits_.axes[i]) axes_.mark(static_cast<interpreter::Axis>(i));
  take_over(at_, at);
  queue_builder_.begin(at_);
  planner_.invalidate();
  spindle_.stop();
  withheld_spindle_.reset();
  stop_ = MachineState::Idle;
  origin_ = {};
  executed_ = 0;
  shown_ = {};
  is_emergency_ = is_aborting_ = panel_.emergency_stop;
}

void Executor::begin_next(const interpreter::Position& at) {
  const interpreter::Spindle spindle = spindle_.programmed();
  const auto withheld = withheld_spindle_;
  MachineStatus shown;
  shown.tool = shown_.tool;
  shown.next_tool = shown_.next_tool;
  shown.tool_offset = shown_.tool_offset;
  shown.flood = shown_.flood;
  shown.mist = shown_.mist;
  begin(at);
  spindle_.set(spindle);
  withheld_spindle_ = withheld;
  queue_builder_.continue_spindle(withheld.value_or(spindle));
  shown_ = shown;
}

// -- time ------------------------------------------------------------------------------------

double Executor::pass(double by, std::size_t max_actions) {
  double used = 0;
  ask_for_records();
  look_ahead_again();
  for (;;) {
    if (motion_.is_active()) {
      const double left = motion_.left();
      if (left > by - used) {
        motion_.pass(by - used);
        return by;
      }
      used += std::max(left, 0.0);
      motion_.pass_all();
      if (is_jogging_) {
        end_jog();
        continue;
      }
      if (!motion_.reaches_end()) {
        if (may_discard()) discard();
        return used;
      }
      finish_move();
    } else if (is_dwelling_) {
      if (!pass_dwell(by, used)) return used;
    } else if ((max_actions > 0 || continues_regardless()) && may_start()) {
      if (max_actions > 0) --max_actions;
      if (!start_front()) return used;
    } else {
      if (may_discard() && speed_ == 0) discard();
      return used;
    }
  }
}

bool Executor::is_over() const {
  return stop_ == MachineState::Completed || stop_ == MachineState::Alarmed ||
         stop_ == MachineState::Aborted;
}

bool Executor::may_start() const {
  if (queue_.empty()) return false;
  // The end of the last block may follow the end of the program.
  if (stop_ == MachineState::Completed)
    return std::holds_alternative<BlockEnd>(queue_.front().body);
  if (stop_ != MachineState::Idle) return false;
  if (speed_ > 0) return true;
  return !is_aborting_ && (!is_held_ || delays_hold(queue_.front().lock));
}

/// Axes that must come to rest continue into the next moves, and moves that cannot be held are
/// executed to their end, beyond the budget.
bool Executor::continues_regardless() const {
  if (speed_ > 0) return is_held_ || is_aborting_ || lacks_records_;
  return is_held_ && !queue_.empty() && delays_hold(queue_.front().lock);
}

/// False: the dwell continues later. `used` gets the part of `by` that passed.
bool Executor::pass_dwell(double by, double& used) {
  if (is_aborting_ || (is_held_ && !delays_hold(lock_))) return false;
  const double rate = dwell_follows_spindle_ ? lock_.seen(panel_).spindle_override : 1;
  if (rate <= 0) return false;
  const double left = dwell_left_ / rate;
  if (left > by - used) {
    dwell_left_ -= (by - used) * rate;
    used = by;
    return false;
  }
  used += left;
  is_dwelling_ = false;
  finish_action();
  return true;
}

/// False: what was reported before it cannot be written. From rest nothing begins then, and axes
/// that run come to rest along the path.
bool Executor::start_front() {
  Action& action = queue_.front();
  enter(action);
  if (skips(action)) {
    speed_ = 0;
    finish_action();
    return true;
  }
  const bool takes_time = std::holds_alternative<Move>(action.body) ||
                          std::holds_alternative<Wait>(action.body) ||
                          std::holds_alternative<ProbeMarker>(action.body);
  if (takes_time) return_spindle();
  if (takes_time) lacks_records_ = !sink_.on_motion_starts(origin_);
  if (lacks_records_ && speed_ == 0) {
    lacks_records_ = false;
    return false;
  }
  if (const auto* move = std::get_if<Move>(&action.body)) {
    planner_.ensure(queue_, panel_);
    start(*move);
  } else if (const auto* wait = std::get_if<Wait>(&action.body)) {
    is_dwelling_ = true;
    dwell_follows_spindle_ = wait->follows_spindle;
    dwell_left_ = wait->seconds;
  } else if (std::holds_alternative<ProbeMarker>(action.body)) {
    start_probe();
  } else {
    report(action);
  }
  return true;
}

void Executor::start(const Move& move) {
  show(move);
  motion_.start(move, speed_, goal(move));
}

void Executor::finish_move() {
  speed_ = motion_.exit_speed();
  at_ = motion_.move().path.to;
  const bool is_probe = &motion_.move() == &probe_move_;
  motion_.stop();
  if (is_probe)
    finish_probe();
  else
    finish_action();
}

void Executor::finish_action() {
  const Action& action = queue_.front();
  const bool ends_block = action.ends_block;
  const bool is_single = action.lock.seen(panel_).single_block;
  const interpreter::Origin origin = action.origin;
  queue_.pop();
  if (!ends_block) return;
  executed_ = origin.block;
  if (is_single && speed_ == 0 && stop_ == MachineState::Idle) stop_ = MachineState::SingleBlock;
  sink_.on_block_executed(origin);
}

void Executor::discard() {
  if (motion_.is_active()) at_ = position();
  motion_.stop();
  is_dwelling_ = lacks_records_ = false;
  speed_ = 0;
  queue_.clear();
  queue_builder_.close();
  if (!is_aborting_) return;
  is_aborting_ = is_held_ = false;
  stop_ = MachineState::Aborted;
  sink_.on_aborted();
}

// -- probing ---------------------------------------------------------------------------------

void Executor::start_probe() {
  interpreter::Probe& probe = *queue_.probe;
  // The interpreter's own end point, so that a trace without a machine is the same.
  probe.result = workpiece_.probe(probe);
  Coordinates target = at_;
  take_over(target, probe.result->at);
  const Path path = probe.arc ? arc_path(at_, arc_of(probe)) : straight_path(at_, target);
  if (path.length == 0) return finish_probe();
  MoveBuilder builder(limits_);
  const Pace pace = probe.is_rapid ? Pace::Rapid : Pace::Feed;
  const MoveTask task{.path = path, .pace = pace, .feed = probe.feed, .lead = {}};
  if (auto refusal = builder.build(task, spindle_, probe_move_)) {
    queue_.alarm = interpreter::Diagnostic{
        .id = refusal->id, .text = std::move(refusal->text), .line = probe.origin.line};
    return report_alarm(probe.origin);
  }
  probe_move_.exit_square = 0;
  start(probe_move_);
}

void Executor::finish_probe() {
  queue_builder_.end_probe(at_);
  const interpreter::Probe probe = *queue_.probe;
  queue_.probe.reset();
  finish_action();
  sink_.on_probed(probe);
}

// -- the plan ---------------------------------------------------------------------------------

/// More was queued: the present move may end faster than when it was the last one.
void Executor::look_ahead_again() {
  if (!is_of_queue()) return;
  const double before = motion_.move().exit_square;
  planner_.ensure(queue_, panel_);
  if (motion_.move().exit_square != before) motion_.change(goal(motion_.move()));
}

void Executor::plan_motion_again() {
  if (!motion_.is_active()) return;
  if (is_of_queue()) planner_.ensure(queue_, panel_);
  motion_.change(goal(motion_.move()));
}

// -- what it does now ------------------------------------------------------------------------

double Executor::speed() const {
  return motion_.is_active() ? motion_.speed() : speed_;
}

Coordinates Executor::position() const {
  return motion_.is_active() ? motion_.move().path.at(motion_.distance()) : at_;
}

double Executor::buffered() const {
  double seconds = queue_.seconds();
  if (motion_.is_active() && !is_jogging_ && motion_.move().path.length > 0)
    seconds -= queue_.front().seconds * motion_.distance() / motion_.move().path.length;
  if (is_dwelling_) seconds -= queue_.front().seconds - dwell_left_;
  return std::max(seconds, 0.0);
}

MachineState Executor::state() const {
  if (is_over()) return stop_;
  if (is_emergency_) return MachineState::EmergencyStop;
  if (is_held_ || is_aborting_) return MachineState::Held;
  if (stop_ != MachineState::Idle) return stop_;
  const bool is_busy = motion_.is_active() || is_dwelling_ || !queue_.empty();
  return is_busy ? MachineState::Running : MachineState::Idle;
}

void Executor::show(const Move& move) {
  if (move.pace == Pace::Rapid)
    shown_.motion = MotionKind::Rapid;
  else if (move.pace == Pace::Thread)
    shown_.motion = MotionKind::Thread;
  else if (!move.path.is_arc())
    shown_.motion = MotionKind::Line;
  else
    shown_.motion =
        move.path.circle.sweep > 0 ? MotionKind::Counterclockwise : MotionKind::Clockwise;
}

MachineStatus Executor::status() const {
  const Coordinates now = position();
  // during a rapid move the spindle already has the speed of the diameter at its end
  const bool is_rapid = motion_.is_active() && motion_.move().pace == Pace::Rapid;
  const Path* path = is_rapid ? &motion_.move().path : nullptr;
  const double x = path != nullptr ? path->at(path->length)[0] : now[0];
  const OperatorPanel in_force = lock_.seen(panel_);
  const double turn = spindle_.rpm(x, in_force.spindle_override);
  MachineStatus status = shown_;
  status.state = state();
  status.is_tapping = lock_.is_tapping;
  status.position = to_position(now, axes_);
  status.target = to_position(motion_.is_active() ? motion_.move().path.to : at_, axes_);
  status.feed_per_minute = is_moving() ? speed() * 60 : 0;
  status.spindle_rpm = spindle_.is_counterclockwise() ? -turn : turn;
  status.origin = origin_;
  status.executed = executed_;
  status.buffered = Seconds{buffered()};
  status.queued = queue_.size();
  status.stopped_at = stopped_at_;
  status.is_feed_limited = motion_.is_active() && motion_.move().is_limited(in_force);
  status.dwell_left = Seconds{is_dwelling_ ? dwell_left_ : 0};
  status.spindle = spindle_.programmed();
  return status;
}

}  // namespace dripline::machine::impl
