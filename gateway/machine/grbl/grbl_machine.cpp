#include "gateway/machine/grbl/grbl_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/grbl/board_link.hpp"
#include "gateway/machine/grbl/machine_check.hpp"

namespace dripline::machine::grbl {

using interpreter::Axis;
using interpreter::Origin;
using interpreter::Position;

namespace {

Coordinates coordinates_of(const Position& position) {
  Coordinates point{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) point[i] = position.raw(static_cast<Axis>(i));
  return point;
}

double known_feed(double factor) {
  constexpr double kLeast = 0.1;
  return factor < kLeast ? 0 : factor;
}

/// The board has 100, 50 and 25 %; never faster than asked.
double known_rapid(double factor) {
  if (factor >= 1) return 1;
  if (factor >= 0.5) return 0.5;
  return factor >= 0.25 ? 0.25 : 0;
}

int percent(double factor) {
  return static_cast<int>(std::clamp(std::floor(factor * 100 + 1e-6), 10.0, 200.0));
}

}  // namespace

Position position_of(const Coordinates& point, std::size_t axes) {
  Position position;
  for (std::size_t i = 0; i < axes; ++i) position.set_raw(static_cast<Axis>(i), point[i]);
  return position;
}

GrblMachine::GrblMachine(Parts parts)
    : sink_(parts.sink),
      clock_(std::move(parts.clock)),
      stated_(std::move(parts.machine)),
      builder_(LineWriter(BoardInfo{})),
      capabilities_{.axes = {},
                    .arcs = true,
                    .threads = false,
                    .spindle_feedback = false,
                    .probing = true,
                    .feed_override = true,
                    .rapid_override = true,
                    .spindle_override = true,
                    .single_block = true,
                    .handwheel = false,
                    .simulated_time = false,
                    .places_axes = false},
      session_(parts.limits) {}

GrblMachine::~GrblMachine() = default;

void GrblMachine::connect(const std::string& address) {
  link_ = std::make_unique<BoardLink>(*this, address);
}

void GrblMachine::wake() {
  if (link_) link_->wake();
}

// -- the line's side -----------------------------------------------------------------------------

void GrblMachine::line_opened() {
  const Lock lock(mutex_);
  session_.opened(clock_->steady_now());
}

void GrblMachine::line_lost(const std::string& reason) {
  const Lock lock(mutex_);
  session_.lost(reason);
}

void GrblMachine::line_closing() {
  const Lock lock(mutex_);
  is_allowed_ = false;
  if (session_.is_ready() && !session_.is_empty()) session_.hold(clock_->steady_now());
}

BoardOutput GrblMachine::exchange(std::span<const std::byte> bytes) {
  const Lock lock(mutex_);
  const SteadyTime now = clock_->steady_now();
  if (!bytes.empty()) session_.receive(bytes, now);
  session_.tick(now);
  pump();
  return session_.take_output();
}

std::string GrblMachine::reopen_reason() const {
  const Lock lock(mutex_);
  return session_.wants_reopen() ? session_.not_ready() : std::string();
}

bool GrblMachine::may_open() const {
  const Lock lock(mutex_);
  return session_.may_open();
}

bool GrblMachine::is_over() const {
  return stop_ == MachineState::Completed || stop_ == MachineState::Alarmed ||
         stop_ == MachineState::Aborted;
}

bool GrblMachine::may_begin() const {
  return stop_ == MachineState::Idle && is_allowed_ && !is_aborting_ && !is_emergency_ &&
         !is_override_hold_ && !session_.is_held() && !session_.fault();
}

// -- the owner's side ----------------------------------------------------------------------------

const MotionCapabilities& GrblMachine::capabilities() const {
  const Lock lock(mutex_);
  capabilities_.axes.reset();
  for (std::size_t i = 0; i < session_.board().axes(); ++i) capabilities_.axes.set(i);
  return capabilities_;
}

Result<void> GrblMachine::check_begin(const Position& at) const {
  const Lock lock(mutex_);
  if (auto ready = session_.check_ready(); !ready) return ready;
  const BoardInfo& board = session_.board();
  if (auto same = check_machine(stated_, board); !same) return same;
  for (std::size_t i = 0; i < interpreter::kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    const double wanted = at.raw(axis);
    if (i >= board.axes()) {
      if (wanted == 0) continue;
      return fail(Errc::Conflict, "the setup begins at {} {}, the board has no such axis",
                  interpreter::letter(axis), wanted);
    }
    const double is_at = session_.position()[i];
    if (std::fabs(is_at - wanted) <= board.tolerance(i)) continue;
    return fail(Errc::Conflict, "{} is at {:.3f}, the setup begins at {:.3f}",
                interpreter::letter(axis), is_at, wanted);
  }
  return {};
}

void GrblMachine::begin(const Position& at) {
  const Lock lock(mutex_);
  discard();
  const BoardInfo& board = session_.board();
  // From where the axes are: the setup is within half a step of it.
  const Coordinates wanted = coordinates_of(at);
  builder_.begin(LineWriter(board), wanted);
  expected_ = wanted;
  axes_ = position_of({}, board.axes());
  preamble_ = Preamble::None;
  inhibit_ = {};
  apply_overrides();
  is_allowed_ = is_board_held_by_override_ = false;
  is_aborting_ = is_emergency_;
  stop_ = MachineState::Idle;
  shown_ = {};
  origin_ = {};
  executed_ = 0;
  session_.set_active(false);
}

bool GrblMachine::has_room() const {
  const Lock lock(mutex_);
  // Blocks of a tenth of a millisecond are executed by the thousand before a report shows it.
  constexpr std::size_t kMaxUnreported = 8 * kMaxActions;
  const std::size_t made = queue_.size() + builder_.size();
  return made - next_ < kMaxActions && made < kMaxUnreported;
}

bool GrblMachine::drained() const {
  const Lock lock(mutex_);
  return queue_.empty() && builder_.size() == 0 && session_.is_empty();
}

Seconds GrblMachine::buffered() const {
  const Lock lock(mutex_);
  return Seconds{queued_seconds_};
}

void GrblMachine::apply_overrides() {
  session_.set_overrides(
      {.feed = inhibit_.feed_override ? 100 : percent(panel_.feed_override),
       .rapid = static_cast<int>(std::max(panel_.rapid_override, 0.25) * 100),
       .spindle = inhibit_.spindle_override ? 100 : percent(panel_.spindle_override)});
}

void GrblMachine::set_panel(const OperatorPanel& panel) {
  {
    const Lock lock(mutex_);
    const SteadyTime now = clock_->steady_now();
    const bool was_emergency = panel_.emergency_stop;
    panel_ = panel.clamped();
    panel_.feed_override = known_feed(panel_.feed_override);
    panel_.rapid_override = known_rapid(panel_.rapid_override);
    panel_.handwheel = false;
    is_single_block_ = panel_.single_block;
    is_emergency_ = panel_.emergency_stop;
    apply_overrides();
    if (is_emergency_ && !was_emergency) {
      if (!is_over()) is_aborting_ = true;
      session_.stop(true, now);
    } else if (was_emergency && !is_emergency_ && session_.fault()) {
      session_.restart(now);
    }
    hold_by_override(now);
  }
  if (panel_.emergency_stop) report_off();
  wake();
}

/// Raising the override ends its own hold, never one that the operator or the board has begun.
void GrblMachine::hold_by_override(SteadyTime now) {
  const bool was_zero =
      std::exchange(is_override_hold_, panel_.feed_override == 0 || panel_.rapid_override == 0);
  if (is_override_hold_ && !was_zero && session_.is_active() && !session_.is_held()) {
    session_.hold(now);
    is_board_held_by_override_ = true;
  } else if (!is_override_hold_ && std::exchange(is_board_held_by_override_, false)) {
    (void)session_.resume(now);
  }
}

/// A board that is reset switches spindle and coolant off; one that is not there may not.
void GrblMachine::report_off() {
  interpreter::Spindle off;
  bool had_spindle = false, had_coolant = false;
  {
    const Lock lock(mutex_);
    if (!session_.is_open()) return;
    off.origin = origin_;
    had_spindle = std::exchange(shown_.spindle, off).state != interpreter::SpindleState::Off;
    had_coolant = std::exchange(shown_.flood, false);
    had_coolant |= std::exchange(shown_.mist, false);
  }
  if (had_spindle) sink_.on_spindle(off);
  if (had_coolant) sink_.on_coolant({off.origin, false, false});
}

void GrblMachine::hold() {
  {
    const Lock lock(mutex_);
    is_board_held_by_override_ = false;
    if (!is_over() && !is_aborting_) session_.hold(clock_->steady_now());
  }
  wake();
}

bool GrblMachine::resume() {
  bool has_resumed = false;
  {
    const Lock lock(mutex_);
    if (is_emergency_ || is_aborting_ || is_over() || is_override_hold_) return false;
    if (session_.is_held()) {
      has_resumed = session_.resume(clock_->steady_now());
    } else if (stop_ != MachineState::Idle) {
      stop_ = MachineState::Idle;
      has_resumed = true;
    }
  }
  wake();
  return has_resumed;
}

void GrblMachine::abort() {
  {
    const Lock lock(mutex_);
    if (is_over() || is_aborting_) return;
    is_aborting_ = true;
    session_.stop(false, clock_->steady_now());
  }
  wake();
}

Result<void> GrblMachine::home() {
  const Lock lock(mutex_);
  if (is_emergency_) return fail(Errc::Busy, "the emergency stop is pressed");
  return session_.reference(true, clock_->steady_now());
}

Result<void> GrblMachine::unlock() {
  const Lock lock(mutex_);
  if (is_emergency_) return fail(Errc::Busy, "the emergency stop is pressed");
  return session_.reference(false, clock_->steady_now());
}

std::string GrblMachine::notice() const {
  const Lock lock(mutex_);
  if (session_.door_is_open()) return "the safety door is open";
  if (session_.is_held()) return {};
  const auto ready = session_.check_ready();
  return ready || current_state() == MachineState::Running ? std::string() : ready.error().what;
}

MachineState GrblMachine::current_state() const {
  if (is_over()) return stop_;
  if (is_emergency_) return MachineState::EmergencyStop;
  if (session_.is_held() || is_aborting_) return MachineState::Held;
  if (stop_ != MachineState::Idle) return stop_;
  const bool is_busy = !queue_.empty() || session_.is_moving() || !session_.is_empty();
  return is_busy ? MachineState::Running : MachineState::Idle;
}

MachineState GrblMachine::state() const {
  const Lock lock(mutex_);
  return current_state();
}

bool GrblMachine::is_moving() const {
  const Lock lock(mutex_);
  return session_.is_moving() || session_.is_stopping();
}

MachineStatus GrblMachine::status() const {
  const Lock lock(mutex_);
  MachineStatus status = shown_;
  const auto& report = session_.report();
  const std::size_t axes = session_.board().axes();
  status.state = current_state();
  status.position = position_of(session_.position(), axes);
  status.target = status.position;
  if (!queue_.empty()) {
    if (const auto* motion = std::get_if<Motion>(&queue_.front().body))
      status.target = position_of(motion->end, axes);
  }
  if (report && session_.is_moving())
    status.feed_per_minute = report->feed.value_or(0) * session_.board().report_scale();
  const double rpm = report ? report->spindle.value_or(0) : 0;
  const bool is_reversed = shown_.spindle.state == interpreter::SpindleState::Counterclockwise;
  status.spindle_rpm = is_reversed ? -rpm : rpm;
  status.origin = origin_;
  status.executed = executed_;
  status.buffered = Seconds{queued_seconds_};
  status.queued = queue_.size();
  status.stopped_at = stopped_at_;
  return status;
}

}  // namespace dripline::machine::grbl
