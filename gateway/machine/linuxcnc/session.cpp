// The link and what comes over it. The program's side is in session_feed.cpp.
#include "gateway/machine/linuxcnc/session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/base/utf8.hpp"

namespace dripline::machine::linuxcnc {

using std::chrono::milliseconds;

namespace {

constexpr milliseconds kHoldAgain{500};
constexpr double kStandstill = 1e-9;

}  // namespace

void Session::opened(SteadyTime now) {
  phase_ = Phase::Starting;
  phase_began_ = heard_ = second_began_ = now;
  bytes_in_second_ = 0;
  reopen_reason_.clear();
  commands_.clear();
  lines_.reset();
  hello_.reset();
  rules_ = {};
  status_.reset();
  signal_.reset();
  homing_.reset();
  command_number_ = done_number_ = awaited_ = must_obey_ = shown_number_ = overrides_number_ = 0;
  has_sent_overrides_ = are_overrides_due_ = false;
  trouble_ = "LinuxCNC has not answered yet";
  keeps_position_ = true;
  if (feed_ == Feed::Stopping) feed_began_ = now;
  if (is_emergency_)
    must_obey_ = command(R"("do":"emergency")");
  else if (aborts_first_)
    begin_stop(now);
}

/// What LinuxCNC has is executed without us: the next helper's first commands end it.
void Session::lost(const std::string& reason) {
  const bool was_open = phase_ != Phase::Closed;
  phase_ = Phase::Closed;
  reopen_reason_.clear();
  commands_.clear();
  status_.reset();
  if (!fault_) trouble_ = reason;
  if (jog_) end_jog(reason);
  if (!was_open) return;
  if (feed_ == Feed::Wanted) end_feed();
  if (feed_ != Feed::None) {
    aborts_first_ = true;
    feed_ = Feed::Stopping;
  }
  is_held_ = is_resuming_ = false;
  if (!is_active_ || fault_) return;
  fault_ = streamed::DeviceFault{"LCN0005", fmt::format("{}: the position is unknown", reason)};
  is_stopping_ = aborts_first_;  // the next helper reports how far it has come
  stop_limit_ = now_ + limits_.answer;
}

std::uint64_t Session::command(const std::string& members) {
  commands_ += fmt::format("{{\"n\":{},{}}}\n", ++command_number_, members);
  return command_number_;
}

void Session::send_overrides() {
  overrides_number_ = command(fmt::format(
      R"("do":"override","feed":{:.4f},"rapid":{:.4f},"spindle":{:.4f})", overrides_.feed_override,
      overrides_.rapid_override, overrides_.spindle_override));
  has_sent_overrides_ = true;
  are_overrides_due_ = false;
}

void Session::receive(std::span<const std::byte> bytes, SteadyTime now) {
  if (phase_ == Phase::Closed || !reopen_reason_.empty()) return;
  if (now - second_began_ >= std::chrono::seconds(1)) second_began_ = now, bytes_in_second_ = 0;
  bytes_in_second_ += bytes.size();
  if (bytes_in_second_ > limits_.bytes_per_second) {
    reopen_reason_ = "the helper floods";
    return;
  }
  now_ = heard_ = now;
  for (const std::string& line : lines_.feed(bytes))
    std::visit([this, now](const auto& reply) { on(reply, now); }, parse_helper_reply(line));
}

void Session::tick(SteadyTime now, bool is_dry) {
  now_ = now;
  if (phase_ == Phase::Starting && now - phase_began_ > limits_.start)
    reopen_reason_ = "LinuxCNC does not answer";
  if (phase_ == Phase::Ready && now - heard_ > limits_.silence)
    reopen_reason_ = "the helper does not report the state of LinuxCNC";
  if (feed_ == Feed::Opening && now - feed_began_ > limits_.answer)
    raise("LCN0006", with_message("LinuxCNC does not begin the program"), now);
  if (feed_ == Feed::Stopping && phase_ != Phase::Closed && now - feed_began_ > limits_.answer)
    end_feed();
  if (is_stopping_ && now > stop_limit_) is_stopping_ = false;
  if (phase_ == Phase::Ready && !fault_ && are_overrides_due_ && !is_stopping_) send_overrides();
  if (feed_ == Feed::Reading) {
    const bool may_end = text_.empty() && is_dry && markers_.empty() && !in_flight_.empty();
    if (may_end && in_flight_.back() > flushed_ && now - sent_at_ >= limits_.flush)
      flushed_ = write(stop_mode_);
    if (may_end && status_ && status_->motion == 0 && now - sent_at_ >= limits_.dry)
      await_execution();
    watch_stall(now);
  }
  if (has_feed() && feed_ != Feed::Ending && is_dry && text_.empty()) {
    text_ += "\n\n\n";  // as many lines as LinuxCNC reads in a cycle
    line_ += 3;
  }
}

// -- replies -------------------------------------------------------------------------------------

void Session::on(const HelloReply& hello, SteadyTime) {
  if (phase_ != Phase::Starting) return;
  hello_ = hello;
  rules_ = rules_of(hello);
  phase_ = Phase::Ready;
  trouble_.clear();
}

void Session::on(const FatalReply& fatal, SteadyTime) {
  reopen_reason_ = one_line(fatal.text);
}

void Session::on(const GarbageReply& garbage, SteadyTime now) {
  if (!is_active_ || ++garbage_ <= limits_.garbage) return;
  raise("LCN0007",
        fmt::format("{} lines of the helper are none of its protocol, the last: '{}'", garbage_,
                    one_line(garbage.text)),
        now);
}

void Session::on(const DoneReply& done, SteadyTime now) {
  if (done.number > command_number_)
    return raise("LCN0007", "the helper answers a command that it was never sent", now);
  done_number_ = std::max(done_number_, done.number);
  if (jog_ && done.number == jog_->number && !done.problem.empty())
    return end_jog(fmt::format("LinuxCNC refuses it: {}", one_line(done.problem)));
  if (!done.problem.empty() && is_active_)
    raise("LCN0006", fmt::format("LinuxCNC refuses a command: {}", one_line(done.problem)), now);
}

void Session::on(const MessageReply& message, SteadyTime) {
  if (message.is_error())
    last_error_ = fmt::format("error {} of LinuxCNC, {}", message.kind, one_line(message.text));
}

void Session::on(const SignalReply& signal, SteadyTime) {
  if (!signal_ || signal_->name != signal.name) return;
  signal_->value = {signal.value, one_line(signal.problem)};
}

/// Each asking gets a new value.
std::optional<interpreter::SignalValue> Session::signal(const std::string& name, SteadyTime now) {
  constexpr std::string_view kOfNames = "abcdefghijklmnopqrstuvwxyz0123456789.-_";
  if (name.find_first_not_of(kOfNames) != std::string::npos)
    return interpreter::SignalValue{std::nullopt, "no name of a HAL pin"};
  if (phase_ != Phase::Ready)
    return interpreter::SignalValue{std::nullopt, "LinuxCNC is not connected"};
  if (!signal_ || signal_->name != name) {
    signal_ = AskedSignal{name, std::nullopt, now};
    command(fmt::format(R"("do":"hal","name":"{}")", name));
    return std::nullopt;
  }
  if (!signal_->value && now - signal_->since > limits_.answer)
    signal_->value = {std::nullopt, "LinuxCNC does not answer"};
  if (!signal_->value) return std::nullopt;
  auto value = *std::move(signal_->value);
  signal_.reset();
  return value;
}

std::string Session::with_message(std::string text) const {
  return last_error_.empty() ? text : fmt::format("{}: {}", text, last_error_);
}

Coordinates Session::in_mm(const Coordinates& values) const {
  Coordinates result = values;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (!interpreter::is_rotary(static_cast<interpreter::Axis>(i)))
      result[i] = values[i] / hello_->units_per_mm;
  return result;
}

PositionTrust Session::position_trust() const {
  if (!status_) return PositionTrust::Reconnected;
  const bool is_homed = status_->is_homed && !status_->is_homing;
  return is_homed ? PositionTrust::Homed : PositionTrust::Lost;
}

void Session::on(const StatusReply& status, SteadyTime now) {
  if (phase_ != Phase::Ready) return;
  const bool is_changed = status_ != status;
  status_ = status;
  shown_number_ = done_number_;
  position_ = in_mm(status.at);
  if (!status.is_homed || status.is_homing) keeps_position_ = false;
  if (is_changed) changed_at_ = now;
  const bool is_obeyed = done_number_ >= awaited_;
  if (feed_ == Feed::Opening && is_obeyed && status.interpreter != InterpreterState::Idle) {
    feed_ = Feed::Reading;
    changed_at_ = now;
    if (is_held_) hold(now);
  }
  if (feed_ >= Feed::Reading) take_progress(now);
  if (feed_ == Feed::Reading) watch_hold(now);
  watch_end(now);
  watch_state(now);
  watch_jog(now);
  watch_homing(now);
}

void Session::begin_stop(SteadyTime now) {
  feed_began_ = now;
  stop_ = Stop::Pausing;
  awaited_ = command(R"("do":"pause")");
}

void Session::execute_to(std::uint64_t line) {
  executed_ = std::max(executed_, line);
  while (!in_flight_.empty() && in_flight_.front() <= executed_) in_flight_.pop_front();
}

void Session::take_progress(SteadyTime now) {
  if (std::max(status_->motion, status_->read) > line_ + 1)
    return raise("LCN0007",
                 fmt::format("LinuxCNC reports line {}, it was sent {}",
                             std::max(status_->motion, status_->read), line_),
                 now);
  if (status_->motion > 0) execute_to(status_->motion - 1);
  for (; !markers_.empty() && markers_.front() < status_->read; markers_.pop_front())
    execute_to(markers_.front());
  if (in_flight_.empty()) longest_ = {};
}

/// The operator can hold and continue at LinuxCNC itself, too.
void Session::watch_hold(SteadyTime now) {
  if (status_->is_paused) {
    is_held_ = was_paused_ = true;
    if (is_resuming_ && now - hold_sent_ > kHoldAgain) {
      command(R"("do":"resume")");
      hold_sent_ = now;
    }
    return;
  }
  if (std::exchange(was_paused_, false)) {
    is_held_ = is_resuming_ = false;
  } else if (is_resuming_) {
    if (now - hold_sent_ > kHoldAgain) is_held_ = is_resuming_ = false;  // it never paused
  } else if (is_held_ && now - hold_sent_ > kHoldAgain) {
    command(R"("do":"pause")");
    hold_sent_ = now;
  }
}

/// An end that was commanded. The axes are brought to rest before the abort: LinuxCNC reports the
/// line in motion until then, and after it no more.
void Session::watch_end(SteadyTime now) {
  if (stop_ == Stop::Pausing && done_number_ >= awaited_) {
    const bool is_paused = status_->is_paused && status_->velocity < kStandstill;
    const bool is_over =
        status_->interpreter == InterpreterState::Idle || status_->state != TaskState::On;
    if (!is_paused && !is_over && now - feed_began_ < limits_.pause) return;
    stop_ = Stop::Aborting;
    awaited_ = must_obey_ = command(R"("do":"abort")");
    return;
  }
  const bool rests = status_->velocity < kStandstill && status_->queue == 0;
  const bool is_idle = status_->interpreter == InterpreterState::Idle && rests;
  const bool is_off = status_->state != TaskState::On && rests;
  if (done_number_ < awaited_ || !(is_idle || is_off)) return;
  aborts_first_ = is_stopping_ = false;
  stop_ = Stop::None;
  if (feed_ == Feed::Stopping || feed_ == Feed::Ending) end_feed();
}

/// An end that was not: LinuxCNC's message follows its state.
void Session::watch_state(SteadyTime now) {
  const bool is_running = feed_ == Feed::Reading;
  const bool is_off = status_->state != TaskState::On;
  const bool has_stopped =
      is_active_ && !fault_ && !is_stopping_ && !is_emergency_ &&
      (is_off || (is_running && status_->interpreter == InterpreterState::Idle));
  if (!has_stopped) return stopped_since_.reset();
  if (!stopped_since_) stopped_since_ = now;
  if (last_error_.empty() && now - *stopped_since_ < limits_.reason) return;
  if (is_off)
    raise("LCN0002",
          with_message(status_->state == TaskState::Off || status_->state == TaskState::EstopReset
                           ? "LinuxCNC has turned the machine off"
                           : "LinuxCNC is in emergency stop"),
          now);
  else
    raise("LCN0001", with_message("LinuxCNC has stopped the program"), now);
}

void Session::watch_stall(SteadyTime now) {
  if (is_held_ || in_flight_.empty() || fault_) changed_at_ = now;
  if (now - changed_at_ > limits_.stall + longest_)
    raise("LCN0003", with_message("LinuxCNC does not go on with the program"), now);
}

// -- what it does --------------------------------------------------------------------------------

bool Session::is_at_rest() const {
  return phase_ == Phase::Ready && status_ && status_->is_in_position && status_->queue == 0 &&
         status_->velocity < kStandstill;
}

bool Session::is_moving() const {
  return phase_ == Phase::Ready && status_ &&
         (status_->velocity > kStandstill || status_->is_homing || jog_);
}

/// The end of a program, an abort and the emergency stop switch coolant off together with the
/// spindle, whose speed is in the status.
bool Session::has_switched_off() const {
  if (phase_ != Phase::Ready || !status_ || shown_number_ < std::max(awaited_, must_obey_))
    return false;
  const bool has_ended =
      feed_ == Feed::None && stop_ == Stop::None && status_->interpreter == InterpreterState::Idle;
  return status_->spindle_rpm == 0 && (has_ended || status_->state != TaskState::On);
}

double Session::feed_per_minute() const {
  return status_ && hello_ ? status_->velocity * 60 / hello_->units_per_mm : 0;
}

double Session::spindle_rpm() const {
  return status_ ? std::fabs(status_->spindle_rpm) : 0;
}

std::vector<std::pair<std::string, bool>> Session::inputs() const {
  constexpr int kReported = 32;
  std::vector<std::pair<std::string, bool>> inputs;
  if (phase_ != Phase::Ready || !status_) return inputs;
  for (int pin = 0; pin < kReported; ++pin) inputs.emplace_back(std::to_string(pin), input(pin));
  return inputs;
}

bool Session::input(int pin) const {
  if (!status_ || pin < 0 || pin >= 64) return false;
  const std::uint32_t bits = pin < 32 ? status_->inputs : status_->inputs_above;
  return ((bits >> (pin % 32)) & 1U) != 0;
}

}  // namespace dripline::machine::linuxcnc
