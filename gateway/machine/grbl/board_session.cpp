#include "gateway/machine/grbl/board_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "gateway/machine/grbl/codes.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::machine::grbl {

using std::chrono::milliseconds;

namespace {

constexpr char kAskStatus = '?', kFeedHold = '!', kCycleStart = '~', kSoftReset = '\x18';
constexpr milliseconds kAskAgain{500};
constexpr std::array<std::string_view, 3> kIdentification{"$I", "$$", "$#"};

bool rests(const StatusReport& report) {
  switch (report.state) {
    case BoardState::Run:
    case BoardState::Jog:
    case BoardState::Home:
      return false;
    case BoardState::Hold:
      return report.substate.value_or(0) == 0;
    case BoardState::Door:  // 2: braking, 3: leaving
      return report.substate.value_or(0) < 2;
    default:
      return true;
  }
}

/// The commands of one kind of override; the board knows steps of 10 and 1 around 100 %.
struct OverrideBytes {
  char full, more_10, less_10, more_1, less_1;
};
constexpr OverrideBytes kFeedBytes{'\x90', '\x91', '\x92', '\x93', '\x94'};
constexpr OverrideBytes kSpindleBytes{'\x99', '\x9A', '\x9B', '\x9C', '\x9D'};

void append_override(const OverrideBytes& bytes, int percent, std::string& to) {
  to += bytes.full;
  const int change = percent - 100;
  const auto tens = static_cast<std::size_t>(std::abs(change) / 10);
  const auto ones = static_cast<std::size_t>(std::abs(change) % 10);
  to.append(tens, change > 0 ? bytes.more_10 : bytes.less_10);
  to.append(ones, change > 0 ? bytes.more_1 : bytes.less_1);
}

char rapid_byte(int percent) {
  if (percent >= 100) return '\x95';
  return percent >= 50 ? '\x96' : '\x97';
}

}  // namespace

// -- the line ------------------------------------------------------------------------------------

void BoardSession::opened(SteadyTime now) {
  wants_reopen_ = false;
  phase_ = Phase::Waking;
  trouble_ = "the board has not answered yet";
  phase_began_ = now;
  next_poll_ = now;
  splitter_.reset();
  output_.clear();
  unanswered_poll_.reset();
}

void BoardSession::lost(const std::string& reason) {
  const bool was_ready = phase_ != Phase::Closed;
  phase_ = Phase::Closed;
  stop_ = Stop::None;
  wants_reopen_ = false;
  output_.clear();
  trouble_ = reason;
  if (!was_ready) return;
  report_.reset();
  drop_lines();
  ++resets_;
  if (is_active_ && !fault_)
    fault_ = BoardFault{"GRB0005", fmt::format("{}: the position is unknown", reason)};
}

void BoardSession::drop_lines() {
  counter_.reset();
  tracker_.drop();
  is_held_ = is_resuming_ = hold_is_sent_ = false;
  resting_since_.reset();
  homing_limit_.reset();
  sent_overrides_ = {};  // as after a start
  longest_ = {};
}

void BoardSession::receive(std::span<const std::byte> bytes, SteadyTime now) {
  if (phase_ == Phase::Closed) return;
  if (now - second_began_ >= std::chrono::seconds(1)) second_began_ = now, bytes_in_second_ = 0;
  bytes_in_second_ += bytes.size();
  if (bytes_in_second_ > limits_.bytes_per_second) {
    if (is_active_) raise("GRB0007", "the board floods the line", now);
    return;
  }
  for (const std::string& line : splitter_.feed(bytes))
    std::visit([this, now](const auto& reply) { on(reply, now); }, parse_reply(line));
}

void BoardSession::give_up(std::string reason) {
  trouble_ = std::move(reason);
  wants_reopen_ = true;
}

void BoardSession::ask(SteadyTime now) {
  real_time(kAskStatus);
  asked_at_ = now;
  if (!unanswered_poll_) unanswered_poll_ = now;
  // Nothing more is sent before the last line is executed.
  const bool is_awaited = counter_.unanswered_lines() == 0 && !tracker_.is_empty();
  next_poll_ = now + (is_awaited   ? limits_.poll / 2
                      : is_active_ ? limits_.poll
                                   : limits_.idle_poll);
}

void BoardSession::tick(SteadyTime now) {
  if (phase_ == Phase::Closed || phase_ == Phase::Silent || wants_reopen_) return;
  if (phase_ != Phase::Ready && now - phase_began_ > limits_.wake) {
    if (!is_active_ && !fault_) return give_up("the board does not answer");
    if (!fault_) fault_ = BoardFault{"GRB0005", "the board does not answer a reset"};
    stop_ = Stop::None;
    phase_ = Phase::Silent;
    return;
  }
  if (stop_ != Stop::None && phase_ != Phase::Resetting && now >= stop_limit_) reset_board(now);
  // One question at a time: a slow board must not be buried in them. A lost one is repeated.
  const bool is_due = !unanswered_poll_ || now - asked_at_ >= kAskAgain;
  const bool may_ask = phase_ != Phase::Resetting && phase_ != Phase::Identifying;
  if (may_ask && is_due && now >= next_poll_) ask(now);
  if (phase_ != Phase::Ready) return;
  watch_silence(now);
  watch_answers(now);
  if (stop_ == Stop::None && sent_overrides_ != wanted_overrides_) send_overrides();
}

/// Silence is a hold first, then an alarm; without a program the line is opened again.
void BoardSession::watch_silence(SteadyTime now) {
  if (homing_limit_ && now > *homing_limit_) homing_limit_.reset();
  if (!unanswered_poll_ || homing_limit_) return;
  const auto silence = now - *unanswered_poll_;
  if (silence > limits_.lost_after) {
    unanswered_poll_.reset();
    if (is_active_)
      raise("GRB0005", "the board does not report its state: the position is unknown", now);
    else
      give_up("the board does not report its state");
  } else if (silence > limits_.hold_after && is_active_ && !is_held_) {
    hold(now);
  }
}

/// A board at rest that owes an answer has lost a line, or its answer.
void BoardSession::watch_answers(SteadyTime now) {
  const bool owes_answer = counter_.unanswered_lines() > 0;
  const bool owes = (owes_answer || !tracker_.is_empty()) && report_ &&
                    report_->state == BoardState::Idle && stop_ == Stop::None;
  if (!owes) return resting_since_.reset();
  if (!resting_since_) resting_since_ = now;
  if (now - *resting_since_ <= limits_.answer + longest_) return;
  raise("GRB0006",
        owes_answer
            ? "the board is at rest and has not answered a line: it was lost on its way"
            : "the board is at rest and its reports do not show that the last line is executed",
        now);
}

// -- replies -------------------------------------------------------------------------------------

void BoardSession::on(const OkReply&, SteadyTime now) {
  if (phase_ == Phase::Identifying) {
    ++identified_;
    return identify_next(now);
  }
  if (phase_ != Phase::Ready) return;
  std::string line;
  if (counter_.answered(line)) {
    resting_since_.reset();
    end_homing(now);
    if (line.front() != '$') tracker_.answered();
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
    return give_up(fmt::format("the board refuses {}: error {}, {}", kIdentification[identified_],
                               error.code, error_text(error.code)));
  if (phase_ != Phase::Ready) return;
  std::string line;
  const bool is_known = counter_.answered(line);
  end_homing(now);
  if (!is_active_) return;
  if (is_known) line.pop_back();
  raise("GRB0002",
        fmt::format("error {} of the board, {}{}", error.code, error_text(error.code),
                    is_known ? ": " + line : ""),
        now);
}

/// The silence of homing is over.
void BoardSession::end_homing(SteadyTime now) {
  if (!homing_limit_) return;
  homing_limit_.reset();
  unanswered_poll_.reset();
  report_.reset();  // what was reported before it is old
  next_poll_ = now;
}

void BoardSession::on(const AlarmReply& alarm, SteadyTime now) {
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
  if (phase_ == Phase::Silent) return;
  drop_lines();
  ++resets_;
  report_.reset();
  unanswered_poll_.reset();
  info_.take(greeting);
  if (!is_expected && was_ready && is_active_) {
    // Lines that are still on their way would be executed by a board that has lost its position.
    fault_ = BoardFault{"GRB0004", "the board has restarted by itself: the position is unknown"};
    stop_ = Stop::Fault;
    return reset_board(now);
  }
  if (stop == Stop::Fault) {
    phase_ = Phase::Silent;
    trouble_ = fault_ ? fault_->text : "the board was stopped";
    return;
  }
  phase_began_ = now;
  if (stop == Stop::Abort || stop == Stop::Emergency) {
    phase_ = Phase::Ready;  // the same board with the same settings
    next_poll_ = now;
    return;
  }
  info_ = {};
  info_.take(greeting);
  phase_ = Phase::Identifying;
  trouble_ = "the board is being identified";
  identified_ = 0;
  identify_next(now);
}

void BoardSession::identify_next(SteadyTime now) {
  if (identified_ < kIdentification.size()) {
    output_ += std::string(kIdentification[identified_]) + "\n";
    return;
  }
  phase_ = Phase::Ready;
  counter_.set_window(info_.window());
  tracker_.set_capacity(std::nullopt);
  const auto fit = info_.check();
  trouble_ = fit ? std::string() : fit.error().what;
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

void BoardSession::on(const StatusReport& report, SteadyTime now) {
  unanswered_poll_.reset();
  if (phase_ == Phase::Silent || phase_ == Phase::Resetting || phase_ == Phase::Identifying) return;
  const bool is_first = !report_;
  report_ = report;
  take_position(report);
  if (phase_ == Phase::Waking) {
    // A board that moves without its program is stopped, never left to itself.
    if (stop_ == Stop::None && rests(report))
      stop_ = Stop::Wake;
    else if (stop_ == Stop::None)
      begin_stop(Stop::Wake, limits_.brake, now);
  }
  if (stop_ != Stop::None) {
    if (rests(report)) reset_board(now);
    return;
  }
  if (phase_ != Phase::Ready) return;
  if (report.state == BoardState::Idle && tracker_.is_empty() && report.buffers)
    tracker_.set_capacity(report.buffers->free_blocks);
  if (is_first) moved_to_ = position_, moved_at_ = now;
  watch_state(report, now);
  if (stop_ != Stop::None) return;
  if (!tracker_.reported(report, now) && is_active_)
    return raise("GRB0007",
                 fmt::format("the board reports line {}, which it was never sent", *report.line),
                 now);
  watch_motion(report, now);
  correct_overrides(report);
}

void BoardSession::take_position(const StatusReport& report) {
  if (report.work_offset) work_offset_ = *report.work_offset;
  if (report.machine_position) {
    position_ = info_.in_mm(*report.machine_position);
  } else if (report.work_position) {
    AxisValues values = *report.work_position;
    for (std::size_t i = 0; i < values.count; ++i) values.value[i] += work_offset_.value[i];
    position_ = info_.in_mm(values);
  }
}

void BoardSession::watch_state(const StatusReport& report, SteadyTime now) {
  const BoardState state = report.state;
  if (state == BoardState::Hold || state == BoardState::Door) {
    if (door_is_open()) is_resuming_ = false;  // closing the door must not start the axes
    if (is_resuming_ && rests(report)) {
      real_time(kCycleStart);
      cycle_start_is_sent_ = true;
    }
    is_held_ = true;  // also what the board's own button or door has held
    hold_is_sent_ = false;
    return;
  }
  // A report that was made before the hold arrived does not end it.
  if (is_resuming_ && (cycle_start_is_sent_ || !hold_is_sent_)) is_resuming_ = is_held_ = false;
  if (!is_active_) {
    is_held_ = false;
    return;
  }
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

void BoardSession::correct_overrides(const StatusReport& report) {
  if (!report.overrides) return;
  const OverridePercent now{report.overrides->feed, report.overrides->rapid,
                            report.overrides->spindle};
  // A report that was made before our bytes arrived is no difference.
  if (now != sent_overrides_ && ++override_waits_ < 3) return;
  override_waits_ = 0;
  sent_overrides_ = now;
}

void BoardSession::send_overrides() {
  override_waits_ = 0;
  if (sent_overrides_.feed != wanted_overrides_.feed)
    append_override(kFeedBytes, wanted_overrides_.feed, output_);
  if (sent_overrides_.rapid != wanted_overrides_.rapid)
    output_ += rapid_byte(wanted_overrides_.rapid);
  if (sent_overrides_.spindle != wanted_overrides_.spindle)
    append_override(kSpindleBytes, wanted_overrides_.spindle, output_);
  sent_overrides_ = wanted_overrides_;
}

// -- the program ---------------------------------------------------------------------------------

void BoardSession::set_active(bool is_active) {
  if (is_active && !is_active_) garbage_ = 0;
  is_active_ = is_active;
}

Result<void> BoardSession::check_ready() const {
  if (fault_)
    return fail(Errc::Busy, "{}: press and release the emergency stop, which resets the board",
                fault_->text);
  if (phase_ != Phase::Ready || !trouble_.empty()) return fail(Errc::Busy, "{}", trouble_);
  if (!report_) return fail(Errc::Busy, "the board has not reported its state yet");
  switch (report_->state) {
    case BoardState::Idle:
      return {};
    case BoardState::Alarm:
      return fail(Errc::Busy, "the board is in alarm: home the axes ($H), or unlock it ($X)");
    case BoardState::Check:
      return fail(Errc::Busy, "the board is in check mode ($C): nothing would move");
    case BoardState::Door:
      return fail(Errc::Busy, "the safety door is open");
    default:
      return fail(Errc::Busy, "the board is in state {}, not Idle", to_string(report_->state));
  }
}

bool BoardSession::may_send(std::size_t bytes) const {
  return phase_ == Phase::Ready && stop_ == Stop::None && !fault_ && !is_held_ &&
         trouble_.empty() && !wants_reopen_ && counter_.fits(bytes);
}

std::uint64_t BoardSession::send(const std::string& text, bool moves, milliseconds longest) {
  const std::uint64_t serial = tracker_.sent(moves);
  std::string line = fmt::format("N{}{}\n", ExecutionTracker::number_of(serial), text);
  output_ += line;
  counter_.sent(std::move(line));
  longest_ = std::max(longest_, longest);
  return serial;
}

void BoardSession::send_system(const std::string& text) {
  output_ += text + "\n";
  counter_.sent(text + "\n");
}

/// The board is held and reset, so that it drops what it has; then it is left alone.
void BoardSession::raise(std::string_view id, std::string text, SteadyTime now) {
  if (fault_) return;
  fault_ = BoardFault{id, std::move(text)};
  if (phase_ == Phase::Closed || phase_ == Phase::Silent) return;
  begin_stop(Stop::Fault, std::min(limits_.brake, limits_.answer), now);
}

// -- the operator --------------------------------------------------------------------------------

void BoardSession::hold(SteadyTime now) {
  is_held_ = true;
  is_resuming_ = false;
  if (phase_ != Phase::Ready || stop_ != Stop::None) return;
  real_time(kFeedHold);
  hold_is_sent_ = true;
  next_poll_ = std::min(next_poll_, now + milliseconds(20));
}

bool BoardSession::door_is_open() const {
  return report_ && report_->state == BoardState::Door && report_->substate.value_or(0) != 0;
}

bool BoardSession::resume(SteadyTime now) {
  if (!is_held_ || stop_ != Stop::None || fault_ || door_is_open()) return false;
  if (phase_ != Phase::Ready) return false;
  is_resuming_ = true;
  cycle_start_is_sent_ = false;  // `~` goes out with the report that shows standstill
  next_poll_ = std::min(next_poll_, now);
  return true;
}

Result<void> BoardSession::reference(bool is_homing, SteadyTime now) {
  if (fault_ || is_active_) return fail(Errc::Busy, "a program or a fault of the board is active");
  if (phase_ != Phase::Ready || !trouble_.empty()) return fail(Errc::Busy, "{}", trouble_);
  const bool is_at_rest =
      report_ && (report_->state == BoardState::Idle || report_->state == BoardState::Alarm);
  if (!is_at_rest || stop_ != Stop::None || counter_.unanswered_lines() > 0)
    return fail(Errc::Busy, "the board is not at rest");
  send_system(is_homing ? "$H" : "$X");
  homing_limit_ = now + (is_homing ? limits_.homing : limits_.answer);
  return {};
}

void BoardSession::begin_stop(Stop stop, milliseconds brake, SteadyTime now) {
  stop_ = stop;
  stop_limit_ = now + brake;
  is_resuming_ = false;
  output_.clear();
  real_time(kFeedHold);
  next_poll_ = now;
}

void BoardSession::stop(bool is_emergency, SteadyTime now) {
  const bool is_known = phase_ == Phase::Ready;
  if (!is_known || stop_ == Stop::Fault) return;
  begin_stop(is_emergency ? Stop::Emergency : Stop::Abort,
             is_emergency ? limits_.emergency_brake : limits_.brake, now);
}

void BoardSession::reset_board(SteadyTime now) {
  output_.clear();  // lines that have not left must not reach a board that was reset
  real_time(kSoftReset);
  splitter_.reset();
  phase_ = Phase::Resetting;
  phase_began_ = now;
  unanswered_poll_.reset();
}

void BoardSession::restart(SteadyTime now) {
  fault_.reset();
  is_held_ = is_resuming_ = false;
  garbage_ = 0;
  if (phase_ == Phase::Closed) return;
  opened(now);
}

bool BoardSession::is_moving() const {
  return phase_ == Phase::Ready && report_ && !rests(*report_);
}

}  // namespace dripline::machine::grbl
