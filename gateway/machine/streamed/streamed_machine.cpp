#include "gateway/machine/streamed/streamed_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/streamed/machine_check.hpp"

namespace dripline::machine::streamed {

using interpreter::Axis;
using interpreter::Position;

namespace {

/// The text is written as for a run, and dropped.
class Check final : public MotionCheck {
 public:
  Check(std::unique_ptr<CommandWriter> commands, const TextRules& rules, const Coordinates& at)
      : builder_(std::move(commands)) {
    builder_.begin(rules, at);
    builder_.keep_nothing();
  }
  interpreter::EventSink& events() override { return builder_; }
  void set_lengths(const ToolLengths& lengths) override { builder_.set_lengths(lengths); }
  const std::optional<interpreter::Diagnostic>& refusal() const override {
    return builder_.refusal();
  }

 private:
  QueueBuilder builder_;
};

}  // namespace

StreamedMachine::StreamedMachine(Parts parts, Device& device)
    : sink_(parts.sink),
      clock_(std::move(parts.clock)),
      stated_(parts.machine),
      make_commands_(parts.make_commands),
      builder_(make_commands_()),
      capabilities_(parts.capabilities),
      device_(device) {}

StreamedMachine::~StreamedMachine() = default;

const MotionCapabilities& StreamedMachine::capabilities() const {
  const Lock lock(mutex_);
  const TextRules& rules = device_.rules();
  for (std::size_t i = 0; i < kMaxAxes; ++i) capabilities_.axes.set(i, rules.has(i));
  capabilities_.reader = rules.reader;
  return capabilities_;
}

Result<void> StreamedMachine::check_device() const {
  if (auto ready = device_.check_ready(); !ready) return ready;
  if (auto same = check_machine(stated_, device_.rules()); !same) return same;
  const PositionTrust trust = device_.position_trust();
  if (stated_.homing == true && (trust == PositionTrust::Unlocked || trust == PositionTrust::Lost))
    return fail(
        Errc::Conflict,
        "the setup says that the machine is homed before programs (homing), and it has lost "
        "its position since: home it");
  return {};
}

Result<void> StreamedMachine::check_begin(const Position& at) const {
  const Lock lock(mutex_);
  if (auto ready = check_device(); !ready) return ready;
  const TextRules& rules = device_.rules();
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    const double wanted = at.raw(static_cast<Axis>(i));
    if (!rules.has(i)) {
      if (wanted == 0) continue;
      return fail(Errc::Conflict, "the setup begins at {} {}, the machine has no such axis",
                  letter_of(i), wanted);
    }
    const double is_at = device_.position()[i];
    if (std::fabs(is_at - wanted) <= rules.axes[i]->tolerance) continue;
    return fail(Errc::Conflict, "{} is at {:.3f}, the setup begins at {:.3f}", letter_of(i), is_at,
                wanted);
  }
  return {};
}

std::unique_ptr<MotionCheck> StreamedMachine::make_check(const Position& at) const {
  const Lock lock(mutex_);
  return std::make_unique<Check>(make_commands_(), device_.rules(), coordinates_of(at));
}

void StreamedMachine::begin(const Position& at) {
  const Lock lock(mutex_);
  discard();
  // From where the axes are: the setup is within the tolerance of it.
  expected_ = coordinates_of(at);
  builder_.begin(device_.rules(), expected_);
  inhibit_ = {};
  apply_overrides();
  has_begun_ = is_allowed_ = is_held_by_override_ = false;
  is_override_hold_ = panel_.feed_override == 0 || panel_.rapid_override == 0;
  is_aborting_ = is_emergency_;
  is_off_due_ = false;
  stop_ = MachineState::Idle;
  shown_ = {};
  origin_ = {};
  executed_ = 0;
  set_active(false);
}

void StreamedMachine::begin_lengths(const ToolLengths& lengths) {
  const Lock lock(mutex_);
  builder_.set_lengths(lengths);
  shown_.lengths = lengths;
}

void StreamedMachine::set_active(bool is_active) {
  is_active_ = is_active;
  device_.set_active(is_active, now());
}

bool StreamedMachine::has_room() const {
  const Lock lock(mutex_);
  // Blocks of a tenth of a millisecond are executed by the thousand before a report shows it.
  constexpr std::size_t kMaxUnreported = 8 * kMaxActions;
  const std::size_t made = queue_.size() + builder_.size();
  return made - next_ < kMaxActions && made < kMaxUnreported &&
         queued_lines_ + builder_.lines() < kMaxLines;
}

bool StreamedMachine::input(int pin) const {
  const Lock lock(mutex_);
  return device_.input(pin);
}

std::vector<std::pair<std::string, bool>> StreamedMachine::inputs() const {
  const Lock lock(mutex_);
  return device_.inputs();
}

std::optional<interpreter::SignalValue> StreamedMachine::signal(const std::string& name) {
  auto value = [&] {
    const Lock lock(mutex_);
    return device_.signal(name, now());
  }();
  if (!value) wake();
  return value;
}

bool StreamedMachine::drained() const {
  const Lock lock(mutex_);
  return queue_.empty() && builder_.size() == 0 && device_.is_empty();
}

Seconds StreamedMachine::buffered() const {
  const Lock lock(mutex_);
  return Seconds{queued_seconds_};
}

void StreamedMachine::apply_overrides() {
  OperatorPanel panel = panel_;
  if (inhibit_.feed_override) panel.feed_override = 1;
  if (inhibit_.spindle_override) panel.spindle_override = 1;
  device_.set_overrides(panel);
}

void StreamedMachine::set_panel(const OperatorPanel& panel) {
  {
    const Lock lock(mutex_);
    const bool was_emergency = panel_.emergency_stop;
    panel_ = device_.known(panel.clamped());
    panel_.handwheel = false;
    is_single_block_ = panel_.single_block;
    is_emergency_ = panel_.emergency_stop;
    apply_overrides();
    if (is_emergency_ && !was_emergency) {
      if (!is_over()) is_aborting_ = true;
      is_off_due_ = true;
      device_.stop(true, now());
    } else if (was_emergency && !is_emergency_) {
      device_.restart(now());
    }
    hold_by_override();
    if (is_override_hold_ && device_.is_jogging()) device_.stop_jog(now());
  }
  report_off();
  wake();
}

/// A hold of the operator's outlives that of an override.
void StreamedMachine::hold_by_override() {
  const bool was_zero =
      std::exchange(is_override_hold_, panel_.feed_override == 0 || panel_.rapid_override == 0);
  if (is_override_hold_ && !was_zero && is_active_) {
    is_held_by_override_ = !device_.is_held() || device_.is_resuming();
    device_.hold(now());
  } else if (!is_override_hold_ && std::exchange(is_held_by_override_, false)) {
    if (!device_.needs_operator()) (void)device_.resume(now());
  }
}

/// A device that was stopped switches spindle and coolant off: when it has reported so, not before.
void StreamedMachine::report_off() {
  interpreter::Spindle off;
  bool had_spindle = false, had_coolant = false;
  {
    const Lock lock(mutex_);
    if (!is_off()) return;
    is_off_due_ = false;
    off.origin = origin_;
    had_spindle = std::exchange(shown_.spindle, off).state != interpreter::SpindleState::Off;
    had_coolant = std::exchange(shown_.flood, false);
    had_coolant |= std::exchange(shown_.mist, false);
  }
  if (had_spindle) sink_.on_spindle(off);
  if (had_coolant) sink_.on_coolant({off.origin, false, false});
}

void StreamedMachine::hold() {
  if (stop_without_program()) return;
  {
    const Lock lock(mutex_);
    is_held_by_override_ = false;
    if (!is_over() && !is_aborting_) device_.hold(now());
  }
  wake();
}

bool StreamedMachine::resume() {
  bool has_resumed = false;
  {
    const Lock lock(mutex_);
    if (is_emergency_ || is_aborting_ || is_over() || is_override_hold_) return false;
    if (device_.is_held()) {
      has_resumed = device_.resume(now());
    } else if (stop_ != MachineState::Idle) {
      stop_ = MachineState::Idle;
      has_resumed = true;
    }
  }
  wake();
  return has_resumed;
}

bool StreamedMachine::needs_operator() const {
  const Lock lock(mutex_);
  return device_.needs_operator();
}

bool StreamedMachine::continue_unattended() {
  return !needs_operator() && resume();
}

void StreamedMachine::abort() {
  if (stop_without_program()) return;
  {
    const Lock lock(mutex_);
    if (is_over() || is_aborting_) return;
    is_aborting_ = true;
    device_.stop(false, now());
  }
  wake();
}

Result<void> StreamedMachine::home() {
  const Lock lock(mutex_);
  if (is_emergency_) return fail(Errc::Busy, "the emergency stop is pressed");
  return device_.home(now());
}

bool StreamedMachine::stop_homing() {
  {
    const Lock lock(mutex_);
    if (!device_.is_homing()) return false;
    device_.stop_homing(now());
  }
  wake();
  return true;
}

/// False: nothing moves without a program.
bool StreamedMachine::stop_without_program() {
  if (!is_jogging()) return stop_homing();
  stop_jog();
  return true;
}

Result<void> StreamedMachine::unlock() {
  const Lock lock(mutex_);
  if (is_emergency_) return fail(Errc::Busy, "the emergency stop is pressed");
  return device_.unlock(now());
}

std::string StreamedMachine::notice() const {
  const Lock lock(mutex_);
  if (std::string reason = device_.hold_reason(); !reason.empty()) return reason;
  if (device_.is_held() || current_state() == MachineState::Running) return {};
  const auto ready = device_.check_ready();
  return ready ? std::string() : ready.error().what;
}

MachineState StreamedMachine::current_state() const {
  if (is_over()) return stop_;
  if (is_emergency_) return MachineState::EmergencyStop;
  if (device_.is_held() || is_aborting_) return MachineState::Held;
  if (stop_ != MachineState::Idle) return stop_;
  const bool is_busy = !queue_.empty() || device_.is_moving() || !device_.is_empty();
  return is_busy ? MachineState::Running : MachineState::Idle;
}

std::optional<GivenAction::Point> StreamedMachine::rests_at() const {
  const Lock lock(mutex_);
  if (!device_.is_connected() || !device_.is_at_rest() || !device_.keeps_position())
    return std::nullopt;
  return device_.position();
}

PositionTrust StreamedMachine::position_trust() const {
  const Lock lock(mutex_);
  return device_.is_connected() ? device_.position_trust() : PositionTrust::Reconnected;
}

MachineState StreamedMachine::state() const {
  const Lock lock(mutex_);
  return current_state();
}

bool StreamedMachine::is_moving() const {
  const Lock lock(mutex_);
  return device_.is_moving() || device_.is_stopping();
}

MachineStatus StreamedMachine::status() const {
  const Lock lock(mutex_);
  const TextRules& rules = device_.rules();
  MachineStatus status = shown_;
  if (is_off()) {
    status.spindle = {};
    status.flood = status.mist = false;
  }
  status.state = current_state();
  status.position = minus(position_of(device_.position(), rules), status.lengths);
  status.target = status.position;
  if (!queue_.empty())
    if (const auto* motion = std::get_if<Motion>(&queue_.front().body))
      status.target = minus(position_of(motion->end, rules), queue_.front().lengths);
  if (device_.is_moving()) status.feed_per_minute = device_.feed_per_minute();
  const bool is_reversed = shown_.spindle.state == interpreter::SpindleState::Counterclockwise;
  status.spindle_rpm = is_reversed ? -device_.spindle_rpm() : device_.spindle_rpm();
  status.origin = origin_;
  status.executed = executed_;
  status.buffered = Seconds{queued_seconds_};
  status.queued = queue_.size();
  status.stopped_at = stopped_at_;
  return status;
}

}  // namespace dripline::machine::streamed
