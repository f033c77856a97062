#include "gateway/machine/grbl/board_session.hpp"

/// The part of the session that homes and unlocks, and knows when a position is lost.
namespace dripline::machine::grbl {

Result<void> BoardSession::reference(bool is_homing, SteadyTime now) {
  if (fault_ || is_active_) return fail(Errc::Busy, "a program or a fault of the board is active");
  if (phase_ != Phase::Ready || !not_ready_.empty()) return fail(Errc::Busy, "{}", not_ready_);
  if (is_homing && !info_.homes())
    return fail(Errc::Unsupported, "the board does not home ($22=0): unlock it where the axes are");
  const bool is_at_rest =
      report_ && (report_->state == BoardState::Idle || report_->state == BoardState::Alarm);
  if (!is_at_rest || stop_ != Stop::None || counter_.unanswered_lines() > 0)
    return fail(Errc::Busy, "the board is not at rest");
  send_system(is_homing ? "$H" : "$X");
  if (is_homing) lose_position();
  reference_ = is_homing ? PositionTrust::Homed : PositionTrust::Unlocked;
  homing_limit_ = now + (is_homing ? limits_.homing : limits_.answer);
  return {};
}

void BoardSession::stop_homing(SteadyTime now) {
  if (is_homing() && stop_ == Stop::None) begin_stop(Stop::Abort, {}, now);
}

/// The silence of homing is over.
void BoardSession::end_homing(SteadyTime now) {
  if (!homing_limit_) return;
  homing_limit_.reset();
  unanswered_poll_.reset();
  report_.reset();  // what was reported before it is old
  next_poll_ = now;
}

void BoardSession::lose_position() {
  trust_ = PositionTrust::Lost;
  keeps_position_ = false;
}

}  // namespace dripline::machine::grbl
