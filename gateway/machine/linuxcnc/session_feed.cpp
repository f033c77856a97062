// The program that LinuxCNC reads, and the operator's commands.
#include <cmath>
#include <utility>

#include "gateway/machine/linuxcnc/session.hpp"

namespace dripline::machine::linuxcnc {

using streamed::DeviceFault;
using streamed::ProbeEnd;
using streamed::TextRules;

namespace {

constexpr std::string_view kMarker = "M66P0L0";
constexpr int kWorkSystem = 9;  // G59.3
constexpr int kMaxReadAhead = 100;
/// LinuxCNC looks for a % in the first line and cannot go back in a FIFO. With it, lines count
/// from 1, this one included.
constexpr std::string_view kFirstLine = "%";
constexpr std::string_view kModes = "G21G90G94G17G40G49G80G91.1G59.3G92.2G8G97M5M9M53P1";
constexpr std::string_view kMoreModes = "G61M48";
constexpr std::string_view kEnd = "M2\n%\n";

}  // namespace

TextRules Session::rules_of(const HelloReply& hello) const {
  constexpr double kMaxBraking = 4;
  TextRules rules;
  rules.decimals = 6;
  rules.line_limit = 200;
  rules.has_stop_mode = true;
  const bool is_metric = hello.units_per_mm == 1;
  rules.reader =
      ProgramReader{.control = "rs274ngc",
                    .units = is_metric ? interpreter::Units::Millimeter : interpreter::Units::Inch,
                    .startup_code = hello.startup_code,
                    .settings = hello.settings};
  if (hello.max_rpm > 0) rules.max_rpm = hello.max_rpm;
  rules.max_rpm_setting = " ([SPINDLE_0]MAX_FORWARD_VELOCITY)";
  double braking = 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    if ((hello.axes >> i & 1U) == 0) continue;
    const bool is_rotary = interpreter::is_rotary(static_cast<interpreter::Axis>(i));
    const double unit = is_rotary ? 1 : 1 / hello.units_per_mm;
    TextRules::AxisRules axis;
    axis.steps = 1e5;
    if (hello.velocity[i] > 0) axis.max_rate = hello.velocity[i] * unit * 60;
    if (hello.low[i] < hello.high[i])
      axis.travel = TextRules::Range{hello.low[i] * unit, hello.high[i] * unit};
    axis.travel_setting = fmt::format(" ([AXIS_{}]MIN_LIMIT, MAX_LIMIT)", streamed::letter_of(i));
    rules.axes[i] = std::move(axis);
    // With less ahead LinuxCNC would slow down.
    if (hello.acceleration[i] > 0)
      braking = std::max(braking, hello.velocity[i] / hello.acceleration[i]);
  }
  rules.seconds_ahead = limits_.seconds_ahead + std::min(braking, kMaxBraking);
  return rules;
}

Result<void> Session::check_reference() const {
  if (status_->state == TaskState::Estop)
    return fail(Errc::Busy, "LinuxCNC is in emergency stop: reset it at the machine");
  if (status_->state != TaskState::On)
    return fail(Errc::Busy,
                "LinuxCNC has the machine off: turn it on there, or with `dncgw panel unlock`");
  if (status_->is_homing || !status_->is_homed)
    return fail(Errc::Busy,
                "the axes are not homed: home them at LinuxCNC, or with `dncgw panel home`");
  return {};
}

/// There a target is reached by the sign of its number, not from where the axis is.
Result<void> Session::check_wrapped() const {
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    if ((hello_->wrapped >> i & 1U) != 0)
      return fail(Errc::Unsupported,
                  "LinuxCNC's axis {0} begins again at 360 degrees, and programs count on: set "
                  "[AXIS_{0}]WRAPPED_ROTARY = 0",
                  streamed::letter_of(i));
  }
  return {};
}

Result<void> Session::check_ready() const {
  if (fault_) return fail(Errc::Busy, "{}: press and release the emergency stop", fault_->text);
  if (phase_ != Phase::Ready || !trouble_.empty()) return fail(Errc::Busy, "{}", trouble_);
  if (hello_->units_per_mm != 1 && std::fabs(hello_->units_per_mm * 25.4 - 1) > 1e-6)
    return fail(Errc::Unsupported, "LinuxCNC's unit is {} per mm, neither mm nor inch",
                hello_->units_per_mm);
  if (hello_->read_ahead > kMaxReadAhead)
    return fail(Errc::Unsupported,
                "LinuxCNC reads {} lines before it executes one: set [TASK]INTERP_MAX_LEN = 2",
                hello_->read_ahead);
  if (auto counts = check_wrapped(); !counts) return counts;
  if (!status_) return fail(Errc::Busy, "LinuxCNC has not reported its state yet");
  if (shown_number_ < must_obey_) return fail(Errc::Busy, "LinuxCNC obeys a command");
  if (auto referenced = check_reference(); !referenced) return referenced;
  if (feed_ != Feed::None || status_->interpreter != InterpreterState::Idle)
    return fail(Errc::Busy, "LinuxCNC is executing a program");
  if (!is_at_rest() || jog_) return fail(Errc::Busy, "the axes are moving");
  return {};
}

void Session::set_active(bool is_active, SteadyTime now) {
  if (is_active == is_active_) return;
  is_active_ = is_active;
  stopped_since_.reset();
  if (is_active) {
    garbage_ = 0;
    keeps_position_ = true;  // from here on
    last_error_.clear();
    return;
  }
  if (feed_ == Feed::Reading && in_flight_.empty() && !is_held_) {
    end_program(now);
  } else if (feed_ == Feed::Wanted) {
    end_feed();
  } else if (has_feed() && feed_ != Feed::Ending && feed_ != Feed::Stopping) {
    abort(now);
  }
  is_held_ = is_resuming_ = false;
}

void Session::end_program(SteadyTime now) {
  text_ += kEnd;
  line_ += 2;
  feed_ = Feed::Ending;
  feed_began_ = now;
}

/// LinuxCNC needs some cycles for M2, and refuses what it is asked meanwhile.
bool Session::finish(SteadyTime now) {
  if (feed_ == Feed::Reading) end_program(now);
  if (feed_ == Feed::Wanted) end_feed();
  if (feed_ == Feed::None) return true;
  if (feed_ == Feed::Ending && now - feed_began_ > limits_.answer)
    raise("LCN0006", with_message("LinuxCNC does not end the program"), now);
  return false;
}

void Session::end_feed() {
  feed_ = Feed::None;
  text_.clear();
  in_flight_.clear();
  markers_.clear();
  preamble_ = 0;
  was_paused_ = false;
  longest_ = {};
}

void Session::feed_opened(const std::string& path, SteadyTime now) {
  end_feed();
  line_ = executed_ = flushed_ = 0;
  feed_ = Feed::Opening;
  feed_began_ = now;
  stop_mode_ = "G61";
  write(kFirstLine);
  write(kModes);
  write(kMoreModes);
  // A former program may have left it otherwise; M2 does not change it.
  if (status_ && status_->is_adaptive != hello_->is_adaptive)
    write(hello_->is_adaptive ? "M52P1" : "M52P0");
  preamble_ = write(kMarker);
  in_flight_.push_back(preamble_);
  markers_.push_back(preamble_);
  // LinuxCNC keeps those of another helper, or of its own screen. Not before: it may be at
  // something of its own.
  if (!has_sent_overrides_) send_overrides();
  awaited_ = command(fmt::format(R"("do":"run","file":"{}")", path));
}

std::uint64_t Session::write(std::string_view line) {
  text_ += line;
  text_ += '\n';
  return ++line_;
}

bool Session::prepare(SteadyTime now) {
  if (fault_ || phase_ != Phase::Ready || is_stopping_) return false;
  if (feed_ == Feed::None) {
    feed_ = Feed::Wanted;
    feed_began_ = now;
    return false;
  }
  if (feed_ != Feed::Reading || executed_ < preamble_) return false;
  if (status_->work_system == kWorkSystem && !status_->has_offset) return true;
  raise("LCN0004",
        "programs run in machine coordinates, but LinuxCNC's work system G59.3 is not zero (or a "
        "G92 offset, a tool length or a rotation is in force)",
        now);
  return false;
}

bool Session::may_send(std::size_t bytes) const {
  constexpr std::size_t kMaxText = 4096;
  return feed_ == Feed::Reading && !fault_ && !is_stopping_ && !is_held_ &&
         reopen_reason_.empty() && text_.size() + bytes < kMaxText &&
         in_flight_.size() < limits_.lines_ahead;
}

std::uint64_t Session::send(const std::string& line, bool, std::chrono::milliseconds longest) {
  if (line.starts_with("G61.1"))
    stop_mode_ = "G61.1";
  else if (line.starts_with("G61"))
    stop_mode_ = "G61";
  in_flight_.push_back(write(line));
  longest_ = std::max(longest_, longest);
  sent_at_ = now_;
  return line_;
}

/// LinuxCNC keeps the last straight move back, in case the next one continues it. A marker is not
/// only the proof that it was executed, it also lets it begin.
void Session::await_execution() {
  if (feed_ != Feed::Reading || in_flight_.empty()) return;
  if (!markers_.empty() && markers_.back() > in_flight_.back()) return;
  markers_.push_back(write(kMarker));
}

std::optional<bool> Session::is_touching() const {
  return status_ ? std::optional(status_->is_touching) : std::nullopt;
}

std::optional<ProbeEnd> Session::probe() const {
  if (!status_ || !hello_) return std::nullopt;
  return ProbeEnd{.tripped = status_->is_tripped, .at = in_mm(status_->probed)};
}

// -- stopping ------------------------------------------------------------------------------------

void Session::abort(SteadyTime now) {
  text_.clear();
  const bool is_reading = feed_ == Feed::Reading;
  if (has_feed()) feed_ = Feed::Stopping;
  if (feed_ == Feed::Wanted) feed_ = Feed::None;
  feed_began_ = now;
  if (phase_ != Phase::Ready) {
    aborts_first_ = has_feed();
  } else if (is_reading) {
    begin_stop(now);
  } else {
    stop_ = Stop::Aborting;
    awaited_ = must_obey_ = command(R"("do":"abort")");
  }
}

void Session::raise(std::string_view id, std::string text, SteadyTime now) {
  if (fault_) return;
  fault_ = DeviceFault{id, std::move(text)};
  is_held_ = is_resuming_ = false;
  abort(now);
  is_stopping_ = phase_ == Phase::Ready;
  stop_limit_ = now + limits_.answer;
}

void Session::stop(bool is_emergency, SteadyTime now) {
  is_emergency_ = is_emergency_ || is_emergency;
  // What `opened` has queued was before the stop; the helper executes it after its hello.
  if (phase_ == Phase::Starting)
    must_obey_ = command(is_emergency ? R"("do":"emergency")" : R"("do":"abort")");
  if (phase_ != Phase::Ready) return;
  abort(now);
  if (is_emergency) {
    stop_ = Stop::Aborting;
    commands_.clear();
    awaited_ = must_obey_ = command(R"("do":"emergency")");
  }
  is_stopping_ = true;
  stop_limit_ = now + limits_.answer;
  is_held_ = is_resuming_ = false;
}

void Session::restart(SteadyTime) {
  fault_.reset();
  is_held_ = is_resuming_ = is_emergency_ = false;
  if (phase_ == Phase::Ready) must_obey_ = command(R"("do":"reset")");
}

// -- the operator --------------------------------------------------------------------------------

void Session::hold(SteadyTime now) {
  is_held_ = true;
  is_resuming_ = false;
  if (feed_ != Feed::Reading || phase_ != Phase::Ready) return;
  command(R"("do":"pause")");
  hold_sent_ = now;
}

bool Session::resume(SteadyTime now) {
  if (!is_held_ || is_stopping_ || fault_) return false;
  if (feed_ != Feed::Reading) {
    is_held_ = false;
    return true;
  }
  if (phase_ != Phase::Ready) return false;
  command(R"("do":"resume")");
  is_resuming_ = true;
  hold_sent_ = now;
  return true;
}

void Session::set_overrides(const OperatorPanel& panel) {
  const OperatorPanel before = std::exchange(overrides_, {});
  overrides_.feed_override = panel.feed_override;
  overrides_.rapid_override = panel.rapid_override;
  overrides_.spindle_override = panel.spindle_override;
  if (overrides_ != before) are_overrides_due_ = true;
}

Result<void> Session::home(SteadyTime now) {
  if (auto ready = unlock({}); !ready) return ready;
  must_obey_ = command(R"("do":"home")");
  homing_ = HomingInHand{.number = must_obey_, .seen = now};
  return {};
}

Result<void> Session::unlock(SteadyTime) {
  if (fault_) return fail(Errc::Busy, "{}: press and release the emergency stop", fault_->text);
  if (phase_ != Phase::Ready || !status_)
    return fail(Errc::Busy, "{}",
                trouble_.empty() ? "LinuxCNC has not reported its state yet" : trouble_);
  if (is_active_ || feed_ != Feed::None) return fail(Errc::Busy, "a program is active");
  if (jog_) return fail(Errc::Busy, "the axes are moving");
  if (status_->state == TaskState::Estop && shown_number_ >= must_obey_)
    return fail(Errc::Busy, "LinuxCNC is in emergency stop: reset it first");
  must_obey_ = command(R"("do":"on")");
  return {};
}

}  // namespace dripline::machine::linuxcnc
