#include <algorithm>
#include <array>
#include <utility>

#include "gateway/machine/grbl/board_session.hpp"
#include "gateway/machine/grbl/codes.hpp"
#include "protocol/base/utf8.hpp"

/// The part of the session that takes what the board sends.
namespace dripline::machine::grbl {

using std::chrono::milliseconds;

namespace {

constexpr std::array<std::string_view, 3> kIdentification{"$I", "$$", "$#"};
constexpr int kNotIdle = 8;  ///< error: the command needs a board at rest

bool is_planning(const std::optional<StatusReport>& before, const StatusReport& now) {
  return before && before->buffers && now.buffers &&
         before->buffers->free_blocks != now.buffers->free_blocks;
}

}  // namespace

void BoardSession::on(const OkReply&, SteadyTime now) {
  if (phase_ == Phase::Identifying) {
    ++identified_;
    return identify_next(now);
  }
  if (phase_ != Phase::Ready) return;
  std::string line;
  if (counter_.answered(line)) {
    resting_since_.reset();
    if (homing_limit_ && trust_ == PositionTrust::Lost) trust_ = reference_;
    end_homing(now);
    if (line.front() != '$') tracker_.answered();
    if (take_jog_answer(line, now)) return;
    if (counter_.unanswered_lines() == 0) {
      longest_ = {};
      next_poll_ = std::min(next_poll_, now + milliseconds(5));  // the report that shows it is done
    }
  } else if (is_active_) {
    raise("GRB0007", "the board answers a line that it was never sent", now);
  }
}

void BoardSession::on(const ErrorReply& error, SteadyTime now) {
  if (phase_ == Phase::Identifying)
    return give_up(fmt::format("the board refuses {}: error {}, {}{}", kIdentification[identified_],
                               error.code, error_text(error.code),
                               error.code == kNotIdle ? " (is the safety door open?)" : ""));
  if (phase_ != Phase::Ready) return;
  std::string line;
  const bool is_known = counter_.answered(line);
  end_homing(now);
  if (jog_ && is_known) {
    return end_jog(
        fmt::format("the board refuses it: error {}, {}", error.code, error_text(error.code)));
  }
  if (!is_active_) return;
  if (is_known) line.pop_back();
  raise("GRB0002",
        fmt::format("error {} of the board, {}{}", error.code, error_text(error.code),
                    is_known ? ": " + line : ""),
        now);
}

void BoardSession::on(const AlarmReply& alarm, SteadyTime now) {
  last_alarm_ = fmt::format(" {} ({})", alarm.code, alarm_text(alarm.code));
  if (!grbl::keeps_position(alarm.code)) lose_position();
  if (phase_ != Phase::Ready || stop_ != Stop::None) return;
  end_homing(now);
  if (is_active_)
    raise("GRB0001", fmt::format("alarm {} of the board, {}", alarm.code, alarm_text(alarm.code)),
          now);
}

void BoardSession::on(const Greeting& greeting, SteadyTime now) {
  const bool is_expected = phase_ == Phase::Resetting || phase_ == Phase::Waking;
  const Stop stop = std::exchange(stop_, Stop::None);
  const bool was_ready = phase_ == Phase::Ready;
  if (phase_ != Phase::Resetting && !std::exchange(awaits_greeting_, false)) lose_position();
  is_off_ = true;
  if (phase_ == Phase::Silent) return;
  drop_lines();
  report_.reset();
  unanswered_poll_.reset();
  info_.take(greeting);
  if (!is_expected && was_ready && is_active_) {
    // Lines that are still in transit would be executed by a board that has lost its position.
    fault_ = streamed::DeviceFault{"GRB0004",
                                   "the board has restarted by itself: the position is unknown"};
    stop_ = Stop::Fault;
    return reset_board(now);
  }
  if (stop == Stop::Fault) {
    phase_ = Phase::Silent;
    not_ready_ = fault_ ? fault_->text : "the board was stopped";
    return;
  }
  phase_began_ = now;
  if (stop == Stop::Abort || stop == Stop::Emergency) {
    phase_ = Phase::Ready;  // the same board with the same settings
    next_poll_ = now;
    return;
  }
  info_ = {};
  rules_ = {};
  info_.take(greeting);
  phase_ = Phase::Identifying;
  not_ready_ = "the board is being identified";
  identified_ = 0;
  identify_next(now);
}

void BoardSession::identify_next(SteadyTime now) {
  if (identified_ < kIdentification.size()) {
    output_.lines += std::string(kIdentification[identified_]) + "\n";
    return;
  }
  phase_ = Phase::Ready;
  counter_.set_window(info_.window());
  tracker_.set_capacity(std::nullopt);
  tracker_.set_numbers(info_.line_numbers());
  rules_ = info_.rules();
  const auto fit = info_.check();
  not_ready_ = fit ? std::string() : fit.error().what;
  next_poll_ = now;
}

void BoardSession::on(const GarbageReply& garbage, SteadyTime now) {
  if (phase_ != Phase::Ready || !is_active_ || stop_ != Stop::None) return;
  if (++garbage_ > limits_.garbage)
    raise("GRB0007",
          fmt::format("{} lines of the board are none of its protocol, the last: '{}'", garbage_,
                      one_line(garbage.text)),
          now);
}

void BoardSession::on(const ProbeReply& probe, SteadyTime now) {
  if (probe.at.count != info_.axes() && phase_ == Phase::Ready)
    return on(GarbageReply{fmt::format("a contact of {} axes", probe.at.count)}, now);
  probe_ = probe;
}

/// A position without an axis would put that axis at 0.
bool BoardSession::has_every_axis(const StatusReport& report) const {
  for (const auto& point : {report.machine_position, report.work_position, report.work_offset})
    if (point && point->count != info_.axes()) return false;
  return true;
}

void BoardSession::on(const StatusReport& report, SteadyTime now) {
  unanswered_poll_.reset();
  if (phase_ == Phase::Ready && !has_every_axis(report))
    return on(GarbageReply{"a position that does not have the board's axes"}, now);
  if (phase_ == Phase::Silent || phase_ == Phase::Resetting || phase_ == Phase::Identifying) return;
  const bool is_first = !report_;
  // A board may plan a long arc before it starts, and report Idle or nothing meanwhile.
  constexpr milliseconds kGap{600};
  if (now - reported_at_ > kGap || is_planning(report_, report)) resting_since_.reset();
  report_ = report;
  reported_at_ = now;
  take_position(report);
  if (std::exchange(is_new_line_, false) && report.state == BoardState::Alarm)
    lose_position();  // a board that homes wakes up like this
  if (phase_ == Phase::Waking) {
    // A board that moves without its program is stopped, never left to itself.
    if (stop_ == Stop::None && report.rests())
      stop_ = Stop::Wake;
    else if (stop_ == Stop::None)
      begin_stop(Stop::Wake, limits_.brake, now);
  }
  if (stop_ != Stop::None) return continue_stop(report, now);
  if (phase_ != Phase::Ready) return;
  if (report.state == BoardState::Idle && tracker_.is_empty() && report.buffers)
    tracker_.set_capacity(report.buffers->free_blocks);
  if (is_first) moved_to_ = position_, moved_at_ = now;
  watch_state(report, now);
  if (stop_ != Stop::None) return;
  watch_jog(report, now);
  if (!tracker_.reported(report, now) && is_active_)
    return raise("GRB0007",
                 fmt::format("the board reports line {}, which it was not sent", *report.line),
                 now);
  watch_motion(report, now);
  overrides_.reported(report.overrides);
}

void BoardSession::take_position(const StatusReport& report) {
  if (report.work_offset) work_offset_ = *report.work_offset;
  if (report.machine_position) {
    position_ = info_.in_mm(*report.machine_position);
    has_position_ = true;
  } else if (report.work_position && work_offset_) {  // the first report after a reset has it
    AxisValues values = *report.work_position;
    for (std::size_t i = 0; i < values.count; ++i) values.value[i] += work_offset_->value[i];
    position_ = info_.in_mm(values);
    has_position_ = true;
  }
}

void BoardSession::watch_state(const StatusReport& report, SteadyTime now) {
  const BoardState state = report.state;
  if (state != BoardState::Alarm) last_alarm_.clear();
  if (state == BoardState::Hold || state == BoardState::Door) {
    if (state == BoardState::Door) has_seen_door_ = true;
    if (door_is_open()) is_resuming_ = false;  // closing the door must not start the axes
    if (is_resuming_ && report.rests()) {
      real_time(kCycleStart);
      cycle_start_is_sent_ = true;
    } else if (report.leaves_door() && !is_resuming_ && is_active_) {
      // Begun before the hold arrived, or by the board's own button.
      send_hold();
      next_poll_ = std::min(next_poll_, now + kObeys);
    }
    is_held_ = true;  // also what the board's own button or door has held
    hold_is_sent_ = false;
    return;
  }
  // A report that was made before the hold arrived does not end it.
  if (is_resuming_ && (cycle_start_is_sent_ || !hold_is_sent_)) is_resuming_ = is_held_ = false;
  if (!is_active_) is_held_ = false;
  if (!is_held_) has_seen_door_ = false;
  if (!is_active_) return;
  switch (state) {
    case BoardState::Idle:
    case BoardState::Run:
      // The hold has not arrived: a character was lost.
      if (is_held_ && !hold_is_sent_) {
        real_time(kFeedHold);
        hold_is_sent_ = true;
      } else {
        hold_is_sent_ = false;
      }
      return;
    case BoardState::Alarm:
      return raise("GRB0001", "the board is in alarm", now);
    default:
      return raise("GRB0008",
                   fmt::format("the board is in state {}, which no program of ours causes",
                               to_string(state)),
                   now);
  }
}

void BoardSession::watch_motion(const StatusReport& report, SteadyTime now) {
  if (position_ != moved_to_ || report.state != BoardState::Run) {
    moved_to_ = position_;
    moved_at_ = now;
  } else if (is_active_ && now - moved_at_ > limits_.stall) {
    raise("GRB0006", "the board reports Run and does not move", now);
  }
}

}  // namespace dripline::machine::grbl
