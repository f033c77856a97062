#include "gateway/machine/grbl/board_session.hpp"

#include <algorithm>
#include <utility>

namespace dripline::machine::grbl {

using std::chrono::milliseconds;
using streamed::DeviceFault;

namespace {

constexpr milliseconds kAskAgain{500};
constexpr std::string_view kLost = "GRB0005";
constexpr std::size_t kAdded = 7;  ///< "N99999" and the line's end

}  // namespace

// -- the line ------------------------------------------------------------------------------------

void BoardSession::opened(SteadyTime now) {
  wants_reopen_ = false;
  stop_ = Stop::None;
  phase_ = Phase::Waking;
  keeps_position_ = is_new_line_ = true;
  awaits_greeting_ = false;
  if (trust_ == PositionTrust::Homed) trust_ = PositionTrust::Reconnected;
  not_ready_ = "the board has not answered yet";
  phase_began_ = now;
  next_poll_ = now;
  splitter_.reset();
  drop_output();
  unanswered_poll_.reset();
}

void BoardSession::lost(const std::string& reason) {
  const bool was_ready = phase_ != Phase::Closed;
  phase_ = Phase::Closed;
  stop_ = Stop::None;
  wants_reopen_ = false;
  drop_output();
  not_ready_ = reason;
  if (!was_ready) return;
  report_.reset();
  drop_lines();
  if (is_active_ && !fault_)
    fault_ = DeviceFault{kLost, fmt::format("{}: the position is unknown", reason)};
}

void BoardSession::drop_lines() {
  if (jog_) end_jog(fault_ ? fault_->text : "the board was reset, or its line was lost");
  counter_.reset();
  tracker_.drop();
  preamble_ = Preamble::None;
  is_held_ = is_resuming_ = hold_is_sent_ = has_seen_door_ = false;
  resting_since_.reset();
  homing_limit_.reset();
  overrides_.reset();
  work_offset_.reset();
  has_position_ = false;
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
  not_ready_ = std::move(reason);
  wants_reopen_ = true;
}

void BoardSession::ask(SteadyTime now) {
  real_time(kAskStatus);
  asked_at_ = now;
  if (!unanswered_poll_) unanswered_poll_ = now;
  // Nothing more is sent before the last line is executed.
  const bool is_awaited = (counter_.unanswered_lines() == 0 && !tracker_.is_empty()) || jog_;
  next_poll_ = now + (is_awaited   ? limits_.poll / 2
                      : is_active_ ? limits_.poll
                                   : limits_.idle_poll);
}

void BoardSession::tick(SteadyTime now) {
  if (phase_ == Phase::Closed || phase_ == Phase::Silent || wants_reopen_) return;
  if (phase_ != Phase::Ready && now - phase_began_ > limits_.wake) {
    if (!is_active_ && !fault_) return give_up("the board does not answer");
    if (!fault_) fault_ = DeviceFault{kLost, "the board does not answer a reset"};
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
  step_overrides(now);
}

/// The answer to the status request that follows shows that the board has taken the step.
void BoardSession::step_overrides(SteadyTime now) {
  if (stop_ != Stop::None || unanswered_poll_) return;
  if (is_active_ && overrides_.is_refused())
    return raise("GRB0006", "the board does not take the overrides of its feed and rapid", now);
  const std::string step = overrides_.take_step();
  if (!overrides_.is_in_force()) next_poll_ = std::min(next_poll_, now + kObeys);
  if (step.empty()) return;
  output_.real_time += step;
  ask(now);
}

/// Silence is a hold first, then an alarm; without a program the line is opened again.
void BoardSession::watch_silence(SteadyTime now) {
  if (homing_limit_ && now > *homing_limit_) homing_limit_.reset();
  if (!unanswered_poll_ || homing_limit_) return;
  const auto silence = now - *unanswered_poll_;
  if (silence > limits_.lost_after) {
    unanswered_poll_.reset();
    if (is_active_)
      raise(kLost, "the board does not report its state: the position is unknown", now);
    else
      give_up("the board does not report its state");
  } else if (silence > limits_.hold_after && is_active_ && !is_held_) {
    hold(now);
  }
}

/// A board at rest that owes an answer has lost a line, or its answer. Only time in which it
/// reports counts: silence is another fault.
void BoardSession::watch_answers(SteadyTime now) {
  const bool owes_answer = counter_.unanswered_lines() > 0;
  const bool owes = (owes_answer || !tracker_.is_empty()) && report_ &&
                    report_->state == BoardState::Idle && stop_ == Stop::None;
  if (!owes) return resting_since_.reset();
  if (!resting_since_) resting_since_ = now;
  if (reported_at_ - *resting_since_ <= limits_.answer + longest_) return;
  raise("GRB0006",
        owes_answer
            ? "the board is at rest and has not answered a line: it was lost in transit"
            : "the board is at rest and its reports do not show that the last line is executed",
        now);
}

// -- the program ---------------------------------------------------------------------------------

void BoardSession::set_active(bool is_active, SteadyTime) {
  if (is_active && !is_active_) {
    garbage_ = 0;
    keeps_position_ = true;  // from here on
  }
  if (!is_active) preamble_ = Preamble::None;
  is_active_ = is_active;
}

Result<void> BoardSession::check_ready() const {
  if (fault_)
    return fail(Errc::Busy, "{}: press and release the emergency stop, which resets the board",
                fault_->text);
  if (phase_ != Phase::Ready || !not_ready_.empty()) return fail(Errc::Busy, "{}", not_ready_);
  if (!report_ || !has_position_)
    return fail(Errc::Busy, "the board has not reported its state yet");
  if (is_homing()) return fail(Errc::Busy, "the board homes its axes");
  switch (report_->state) {
    case BoardState::Idle:
      return {};
    case BoardState::Alarm:
      return fail(Errc::Busy, "the board is in alarm{}: home the axes ($H), or unlock it ($X)",
                  last_alarm_);
    case BoardState::Check:
      return fail(Errc::Busy, "the board is in check mode ($C): nothing would move");
    case BoardState::Door:
      return fail(Errc::Busy, "the safety door is open");
    case BoardState::Hold:
      return fail(Errc::Busy,
                  "the board is held: press its cycle start, or press and release the emergency "
                  "stop");
    default:
      return fail(Errc::Busy, "the board is in state {}, not Idle", to_string(report_->state));
  }
}

bool BoardSession::may_send(std::size_t bytes) const {
  return phase_ == Phase::Ready && stop_ == Stop::None && !fault_ && !is_held_ &&
         not_ready_.empty() && !wants_reopen_ && counter_.fits(bytes + kAdded);
}

/// The modes are set and read back before the first line of a program.
bool BoardSession::prepare(SteadyTime now) {
  constexpr std::size_t kPreambleBytes = 64;
  if (preamble_ == Preamble::Done) return true;
  if (!is_empty() || !may_send(kPreambleBytes)) return false;
  switch (preamble_) {
    case Preamble::None:
      work_system_ = info_.work_system();
      send("G21G90G94G17G91.1G49" + work_system_, false, {});
      send("G92.1M5M9", false, {});
      preamble_ = Preamble::Sent;
      return false;
    case Preamble::Sent:
      modes_.reset();
      send_system("$G");
      send_system("$#");
      preamble_ = Preamble::Asked;
      return false;
    case Preamble::Asked:
    case Preamble::Done:
      break;
  }
  if (!check_modes(now)) return false;
  preamble_ = Preamble::Done;
  return true;
}

bool BoardSession::check_modes(SteadyTime now) {
  const std::array<std::string, 4> wanted{"G21", "G90", "G94", work_system_};
  for (const std::string& word : wanted) {
    if (modes_ && std::ranges::find(modes_->words, word) != modes_->words.end()) continue;
    raise("GRB0007", fmt::format("the board does not take the mode {}", word), now);
    return false;
  }
  const std::string offset = info_.offset_beside(work_system_);
  if (offset.empty()) return true;
  raise("GRB0008",
        fmt::format("the board's {} is not zero any more: something else has set it", offset), now);
  return false;
}

std::uint64_t BoardSession::send(const std::string& text, bool moves, milliseconds longest) {
  const std::uint64_t serial = tracker_.sent(moves);
  is_off_ = false;
  off_line_ = 0;
  // A build without line numbers reads them and does nothing with them.
  std::string line = info_.has_line_numbers()
                         ? fmt::format("N{}{}\n", tracker_.number_of(serial), text)
                         : text + "\n";
  output_.lines += line;
  counter_.sent(std::move(line));
  longest_ = std::max(longest_, longest);
  return serial;
}

void BoardSession::switch_off() {
  constexpr std::string_view kOff = "M5M9";
  if (preamble_ != Preamble::None && may_send(kOff.size()))
    off_line_ = send(std::string(kOff), false, {});
}

std::optional<streamed::ProbeEnd> BoardSession::probe() const {
  if (!probe_) return std::nullopt;
  return streamed::ProbeEnd{.tripped = probe_->tripped, .at = info_.in_mm(probe_->at)};
}

void BoardSession::send_system(const std::string& text) {
  output_.lines += text + "\n";
  counter_.sent(text + "\n");
}

/// The board is held and reset, so that it drops what it has; then it is left alone.
void BoardSession::raise(std::string_view id, std::string text, SteadyTime now) {
  if (fault_) return;
  fault_ = DeviceFault{id, std::move(text)};
  if (phase_ == Phase::Closed || phase_ == Phase::Silent) return;
  begin_stop(Stop::Fault, std::min(limits_.brake, limits_.answer), now);
}

void BoardSession::restart(SteadyTime now) {
  if (!fault_) return;
  fault_.reset();
  is_held_ = is_resuming_ = false;
  garbage_ = 0;
  if (phase_ == Phase::Closed) return;
  const PositionTrust trust = trust_;
  const bool is_kept = keeps_position_;
  opened(now);
  // The line was open all the time.
  trust_ = trust;
  keeps_position_ = is_kept;
  is_new_line_ = false;
}

bool BoardSession::is_connected() const {
  return phase_ != Phase::Closed && !(fault_ && fault_->id == kLost);
}

bool BoardSession::is_moving() const {
  return phase_ == Phase::Ready && report_ && !report_->rests();
}

/// The letters of Pn: probe, limits of the axes, door, hold, reset, cycle start.
std::vector<std::pair<std::string, bool>> BoardSession::inputs() const {
  std::vector<std::pair<std::string, bool>> inputs;
  if (phase_ != Phase::Ready || !report_) return inputs;
  for (const char letter : std::string_view("PXYZDHRS"))
    inputs.emplace_back(std::string(1, letter), report_->pins.find(letter) != std::string::npos);
  return inputs;
}

double BoardSession::feed_per_minute() const {
  return report_ ? report_->feed.value_or(0) * info_.report_scale() : 0;
}

double BoardSession::spindle_rpm() const {
  return report_ ? report_->spindle.value_or(0) : 0;
}

}  // namespace dripline::machine::grbl
