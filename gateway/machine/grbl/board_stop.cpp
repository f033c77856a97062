#include <algorithm>
#include <utility>

#include "gateway/machine/grbl/board_session.hpp"

/// The part of the session that holds, resumes, stops and resets the board.
namespace dripline::machine::grbl {

using std::chrono::milliseconds;

/// A board that leaves a safety door takes no feed hold, and then moves the axes. The door's own
/// byte brings it back to where only a cycle start leaves it.
void BoardSession::send_hold() {
  real_time(kFeedHold);
  if (!report_ || report_->state != BoardState::Door) return;
  const bool may_leave = report_->leaves_door() || std::exchange(cycle_start_is_sent_, false);
  if (may_leave) real_time(kSafetyDoor);
}

void BoardSession::hold(SteadyTime now) {
  is_held_ = true;
  is_resuming_ = false;
  if (phase_ != Phase::Ready || stop_ != Stop::None) return;
  send_hold();
  hold_is_sent_ = true;
  next_poll_ = std::min(next_poll_, now + kObeys);
}

/// Or was, when the axes began to brake. At 0 it is closed, at 3 and 4 the spindle comes up.
bool BoardSession::door_is_open() const {
  constexpr int kOpen = 1, kBraking = 2;
  if (!report_ || report_->state != BoardState::Door) return false;
  const int substate = report_->substate.value_or(0);
  return substate == kOpen || substate == kBraking;
}

std::string BoardSession::hold_reason() const {
  return door_is_open() ? "the safety door is open" : "";
}

bool BoardSession::resume(SteadyTime now) {
  if (!is_held_ || stop_ != Stop::None || fault_ || door_is_open()) return false;
  if (phase_ != Phase::Ready) return false;
  is_resuming_ = true;
  cycle_start_is_sent_ = false;  // `~` goes out with the report that shows standstill
  next_poll_ = std::min(next_poll_, now);
  return true;
}

void BoardSession::begin_stop(Stop stop, milliseconds brake, SteadyTime now) {
  stop_ = stop;
  stop_limit_ = now + brake;
  is_resuming_ = false;
  drop_output();
  send_hold();
  next_poll_ = now;
}

/// Each report shows whether the board has obeyed.
void BoardSession::continue_stop(const StatusReport& report, SteadyTime now) {
  // grblHAL takes nothing but a reset there. Its axes are at rest; where they are not, it sends an
  // alarm.
  const bool obeys_no_hold = report.leaves_door() && info_.is_grbl_hal();
  if (report.rests() || obeys_no_hold) return reset_board(now);
  const bool is_in_hold = report.state == BoardState::Hold || report.state == BoardState::Door;
  if (is_in_hold && !report.leaves_door()) return;
  send_hold();
  next_poll_ = std::min(next_poll_, now + kObeys);
}

void BoardSession::stop(bool is_emergency, SteadyTime now) {
  if (!is_emergency) {
    if (phase_ == Phase::Ready && stop_ != Stop::Fault) begin_stop(Stop::Abort, limits_.brake, now);
    return;
  }
  const auto brake = limits_.emergency_brake;
  switch (phase_) {
    case Phase::Ready:
      if (stop_ != Stop::Fault) return begin_stop(Stop::Emergency, brake, now);
      send_hold();
      stop_limit_ = std::min(stop_limit_, now + brake);
      return;
    case Phase::Waking:  // what it does is not known yet
      return begin_stop(Stop::Wake, brake, now);
    case Phase::Silent:  // it was reset, but may not have obeyed
      real_time(kFeedHold);
      real_time(kSoftReset);
      awaits_greeting_ = true;
      return;
    case Phase::Closed:
    case Phase::Resetting:
    case Phase::Identifying:  // it has just been reset
      return;
  }
}

void BoardSession::reset_board(SteadyTime now) {
  if (!report_ || !(report_->rests() || report_->leaves_door())) lose_position();
  drop_output();  // lines that have not left must not reach a board that was reset
  real_time(kSoftReset);
  splitter_.reset();
  phase_ = Phase::Resetting;
  phase_began_ = now;
  unanswered_poll_.reset();
}

}  // namespace dripline::machine::grbl
