#include "gateway/machine/grbl/board_session.hpp"
#include "gateway/machine/grbl/codes.hpp"
#include "protocol/base/decimal.hpp"

/// The part of the session that moves one axis without a program.
namespace dripline::machine::grbl {

using std::chrono::milliseconds;

namespace {

constexpr std::string_view kJogLine = "$J=";

}  // namespace

Result<void> BoardSession::jog(const Jog& jog, SteadyTime now) {
  const std::string line = fmt::format("{}G21G91{}{}F{}", kJogLine, interpreter::letter(jog.axis),
                                       decimal_text(jog.distance, rules_.decimals),
                                       decimal_text(jog.feed_per_minute, 1));
  const bool is_free = counter_.unanswered_lines() == 0 && tracker_.is_empty() && !jog_;
  if (!is_free || !may_send(line.size())) return fail(Errc::Busy, "the board is not at rest");
  jog_fault_.clear();
  jog_ = JogInHand{};
  send_system(line);
  next_poll_ = now;
  return {};
}

void BoardSession::stop_jog(SteadyTime now) {
  if (!jog_ || jog_->cancelled_at) return;
  jog_->cancelled_at = now;
  cancel_jog(now);
}

void BoardSession::cancel_jog(SteadyTime now) {
  if (phase_ != Phase::Ready || stop_ != Stop::None) return;
  real_time(kJogCancel);
  next_poll_ = std::min(next_poll_, now + milliseconds(20));
}

void BoardSession::end_jog(std::string fault) {
  jog_.reset();
  jog_fault_ = std::move(fault);
}

/// A cancel that overtook the line was for nothing: it is repeated.
bool BoardSession::take_jog_answer(const std::string& line, SteadyTime now) {
  if (!jog_ || !line.starts_with(kJogLine)) return false;
  jog_->is_answered = true;
  if (jog_->cancelled_at) cancel_jog(now);
  next_poll_ = now;
  return true;
}

void BoardSession::watch_jog(const StatusReport& report, SteadyTime now) {
  if (!jog_) return;
  const bool is_at_rest = report.rests();
  if (jog_->cancelled_at && !is_at_rest) {
    // A board that does not obey its own byte is held, and reset at rest.
    if (now - *jog_->cancelled_at > limits_.answer)
      return begin_stop(Stop::Abort, limits_.brake, now);
    return cancel_jog(now);
  }
  if (!is_at_rest) return;
  if (!jog_->is_answered) {
    // Some boards drop the lines that they have received with a cancel, without an answer.
    constexpr milliseconds kDropped{1000};
    if (!jog_->cancelled_at || now - *jog_->cancelled_at < kDropped) return;
    counter_.reset();
  }
  if (report.state == BoardState::Idle) return end_jog("");
  if (report.state == BoardState::Alarm) return end_jog("the board is in alarm" + last_alarm_);
  end_jog(fmt::format("the board is in state {}", to_string(report.state)));
}

}  // namespace dripline::machine::grbl
