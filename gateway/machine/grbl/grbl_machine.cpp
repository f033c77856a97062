#include "gateway/machine/grbl/grbl_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/grbl/board_link.hpp"

namespace dripline::machine::grbl {

using interpreter::Axis;
using interpreter::Origin;
using interpreter::Position;

namespace {

constexpr std::chrono::seconds kCommandTime{30};  ///< a spindle may run up with its answer pending

Coordinates coordinates_of(const Position& position) {
  Coordinates point{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) point[i] = position.raw(static_cast<Axis>(i));
  return point;
}

Position position_of(const Coordinates& point, std::size_t axes) {
  Position position;
  for (std::size_t i = 0; i < axes; ++i) position.set_raw(static_cast<Axis>(i), point[i]);
  return position;
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

GrblMachine::GrblMachine(Parts parts)
    : sink_(parts.sink),
      clock_(std::move(parts.clock)),
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

std::string GrblMachine::exchange(std::span<const std::byte> bytes) {
  const Lock lock(mutex_);
  const SteadyTime now = clock_->steady_now();
  if (!bytes.empty()) session_.receive(bytes, now);
  session_.tick(now);
  pump();
  return session_.take_output();
}

std::string GrblMachine::reopen_reason() const {
  const Lock lock(mutex_);
  return session_.wants_reopen() ? session_.trouble() : std::string();
}

bool GrblMachine::may_open() const {
  const Lock lock(mutex_);
  return session_.may_open();
}

// -- sending -------------------------------------------------------------------------------------

bool GrblMachine::is_over() const {
  return stop_ == MachineState::Completed || stop_ == MachineState::Alarmed ||
         stop_ == MachineState::Aborted;
}

bool GrblMachine::may_begin() const {
  return stop_ == MachineState::Idle && is_allowed_ && !is_aborting_ && !is_emergency_ &&
         !is_override_hold_ && !session_.is_held() && !session_.fault();
}

/// Sends the motion that may be sent, up to the first action that must wait for it.
void GrblMachine::pump() {
  if (!is_released_ || !may_begin() || !prepare()) return;
  for (; next_ < queue_.size(); ++next_) {
    Action& action = queue_[next_];
    if (is_single_block_ && action.origin.block != queue_.front().origin.block) return;
    if (std::holds_alternative<BlockEnd>(action.body)) continue;
    auto* motion = std::get_if<Motion>(&action.body);
    if (motion == nullptr) return;
    for (; motion->sent < motion->lines.size(); ++motion->sent) {
      const std::string& line = motion->lines[motion->sent];
      if (!session_.may_send(line.size() + LineWriter::kAdded)) return;
      const bool moves = !line.starts_with("G4");
      motion->last_serial = session_.send(line, moves);
    }
    expected_ = motion->end;
  }
}

/// The modes that all lines rely on are set and read back before the first line of a program.
bool GrblMachine::prepare() {
  const LineWriter& writer = builder_.writer();
  const bool is_current = preamble_resets_ == session_.resets();
  if (preamble_ == Preamble::Done && is_current) return true;
  if (preamble_ == Preamble::None || !is_current) {
    if (!session_.is_empty() || !session_.may_send(80) || !check_position(expected_)) return false;
    for (const std::string& line : writer.preamble()) session_.send(line, false);
    session_.drop_modes();
    preamble_ = Preamble::Sent;
    preamble_resets_ = session_.resets();
    return false;
  }
  if (!session_.is_empty() || !session_.may_send(8)) return false;
  if (preamble_ == Preamble::Sent) {
    session_.send_system("$G");
    preamble_ = Preamble::Asked;
    return false;
  }
  const auto& modes = session_.modes();
  for (const std::string& word : writer.preamble_words()) {
    if (modes && std::ranges::find(modes->words, word) != modes->words.end()) continue;
    session_.raise("GRB0007", fmt::format("the board does not take the mode {}", word),
                   clock_->steady_now());
    return false;
  }
  preamble_ = Preamble::Done;
  return true;
}

/// With nothing in motion the axes must be where the program has sent them.
bool GrblMachine::check_position(const Coordinates& expected) {
  const BoardInfo& board = session_.board();
  const auto& report = session_.report();
  if (!report || report->state != BoardState::Idle) return false;
  for (std::size_t i = 0; i < board.axes(); ++i) {
    if (std::fabs(session_.position()[i] - expected[i]) <= board.tolerance(i)) continue;
    session_.raise(
        "GRB0003",
        fmt::format("{} is at {:.3f}, the program has it at {:.3f}: the board does not do "
                    "what it was sent",
                    letter_of(i), session_.position()[i], expected[i]),
        clock_->steady_now());
    return false;
  }
  return true;
}

// -- delivering ----------------------------------------------------------------------------------

void GrblMachine::take_made() {
  for (Action& action : builder_.take()) {
    queued_seconds_ += action.seconds;
    queue_.push_back(std::move(action));
  }
}

Seconds GrblMachine::poll(Seconds, std::size_t max_actions) {
  {
    Lock lock(mutex_);
    take_made();
    is_allowed_ = max_actions > 0;
    session_.set_active(!is_over());
    while (deliver(lock)) {
    }
    pump();
    session_.set_active(!is_over());
  }
  wake();
  return Seconds{0};
}

/// False: nothing more can be delivered now.
bool GrblMachine::deliver(Lock& lock) {
  if (is_over()) return false;
  if (const auto& fault = session_.fault()) {
    const Origin origin = origin_;
    deliver_alarm(lock, {origin, {.id = fault->id, .text = fault->text, .line = origin.line}});
    return false;
  }
  if (is_aborting_) return end_abort(lock);
  return !queue_.empty() && deliver_front(lock);
}

bool GrblMachine::deliver_front(Lock& lock) {
  Action& action = queue_.front();
  if (std::holds_alternative<BlockEnd>(action.body)) {
    origin_ = action.origin;
    return finish_front(lock);
  }
  if (std::holds_alternative<Motion>(action.body)) return deliver_motion(lock);
  if (!may_begin() || !session_.is_empty()) return false;
  is_released_ = false;
  origin_ = action.origin;
  if (std::holds_alternative<BoardCommand>(action.body)) return deliver_command(lock);
  if (std::holds_alternative<ProbeMove>(action.body)) return deliver_probe(lock);
  if (std::holds_alternative<TextEvent>(action.body)) return deliver_text(lock);
  if (const auto* inhibit = std::get_if<interpreter::OverrideInhibit>(&action.body)) {
    inhibit_ = *inhibit;
    apply_overrides();
    return finish_front(lock);
  }
  if (const auto* alarm = std::get_if<AlarmEvent>(&action.body)) {
    deliver_alarm(lock, {origin_, alarm->diagnostic});
    return false;
  }
  return deliver_stop(lock);
}

/// The last moment to write what was reported before the motion. False: it was announced before.
bool GrblMachine::start_front(Lock& lock) {
  if (std::exchange(has_started_, true)) return false;
  const Origin origin = origin_;
  lock.unlock();
  sink_.on_motion_starts(origin);
  lock.lock();
  return true;
}

bool GrblMachine::deliver_motion(Lock& lock) {
  Action& action = queue_.front();
  auto& motion = std::get<Motion>(action.body);
  origin_ = action.origin;
  shown_.motion = motion.kind;
  if (!is_released_) {
    if (!may_begin()) return false;
    if (start_front(lock)) return true;  // meanwhile a fault may have come
    is_released_ = true;
    pump();
  }
  const bool is_executed =
      motion.sent == motion.lines.size() && session_.tracker().executed() >= motion.last_serial;
  if (!is_executed) return false;
  if (session_.is_empty() && next_ <= 1 && session_.report() &&
      session_.report()->state == BoardState::Idle && !check_position(motion.end))
    return true;  // to the fault
  return finish_front(lock);
}

bool GrblMachine::deliver_command(Lock& lock) {
  if (start_front(lock)) return true;
  if (!prepare()) return false;
  auto& command = std::get<BoardCommand>(queue_.front().body);
  const auto* dwell = std::get_if<interpreter::Dwell>(&command.event);
  if (!command.is_sent) {
    for (const std::string& line : command.lines) {
      const auto time = dwell ? std::chrono::milliseconds(std::llround(dwell->seconds * 1000))
                              : std::chrono::milliseconds(kCommandTime);
      session_.send(line, false, time);
    }
    command.is_sent = true;
    return false;
  }
  const auto event = command.event;
  if (const auto* spindle = std::get_if<interpreter::Spindle>(&event)) {
    shown_.spindle = *spindle;
    lock.unlock();
    sink_.on_spindle(*spindle);
    lock.lock();
  } else if (const auto* coolant = std::get_if<interpreter::Coolant>(&event)) {
    shown_.flood = coolant->flood;
    shown_.mist = coolant->mist;
    lock.unlock();
    sink_.on_coolant(*coolant);
    lock.lock();
  }
  return finish_front(lock);
}

/// The move ends at the contact, as programs take it: the board brakes past it, and is moved back.
bool GrblMachine::deliver_probe(Lock& lock) {
  if (start_front(lock)) return true;
  if (!prepare()) return false;
  auto& move = std::get<ProbeMove>(queue_.front().body);
  if (!move.is_sent && !move.text.lines.empty()) {
    session_.drop_probe();
    session_.send(move.text.lines.front(), true);
    move.is_sent = true;
    return false;
  }
  LineWriter& writer = builder_.writer();
  const auto& reply = session_.probe();
  if (move.is_sent && !reply) {
    session_.raise("GRB0007", "the probe move has ended without a result", clock_->steady_now());
    return true;
  }
  const bool tripped = move.is_sent && reply->tripped;
  const Coordinates end = tripped ? session_.board().in_mm(reply->at) : move.text.end;
  if (tripped && !move.is_returning) {
    move.is_returning = true;
    writer.move_to(session_.position());
    MotionText text;
    const auto refusal = writer.line({.origin = origin_,
                                      .to = position_of(end, session_.board().axes()),
                                      .feed = move.probe.feed},
                                     text);
    if (!refusal && !text.lines.empty()) {
      session_.send(text.lines.front(), true);
      return false;
    }
  }
  writer.move_to(end);
  expected_ = end;
  if (!check_position(end)) return session_.fault().has_value();
  interpreter::Probe probe = move.probe;
  interpreter::Position at = probe.to;
  for (std::size_t i = 0; i < session_.board().axes(); ++i)
    if (at.has(static_cast<Axis>(i))) at.set_raw(static_cast<Axis>(i), end[i]);
  probe.result = interpreter::ProbeResult{tripped, at};
  (void)finish_front(lock);
  lock.unlock();
  sink_.on_probed(probe);
  lock.lock();
  return true;
}

bool GrblMachine::deliver_text(Lock& lock) {
  const TextEvent text = std::get<TextEvent>(queue_.front().body);
  const Origin origin = origin_;
  lock.unlock();
  switch (text.kind) {
    case TextEvent::Kind::Output:
      sink_.on_output({origin, text.device, text.text});
      break;
    case TextEvent::Kind::Open:
      sink_.on_open({origin, text.device, std::nullopt});
      break;
    case TextEvent::Kind::OpenNamed:
      sink_.on_open({origin, text.device, text.text});
      break;
    case TextEvent::Kind::Close:
      sink_.on_close({origin, text.device});
      break;
    case TextEvent::Kind::Message:
      sink_.on_message({origin, text.text});
      break;
    case TextEvent::Kind::Warning:
      sink_.on_warning({origin, {text.id, text.text, text.line, text.column}});
      break;
  }
  lock.lock();
  return finish_front(lock);
}

/// Tool changes, stops and the end.
bool GrblMachine::deliver_stop(Lock& lock) {
  const Action action = queue_.front();
  if (const auto* tool = std::get_if<interpreter::ToolChange>(&action.body)) {
    shown_.next_tool.reset();
    (tool->is_preselection ? shown_.next_tool : shown_.tool) = tool->number;
    if (tool->offset) shown_.tool_offset = tool->offset;
    lock.unlock();
    sink_.on_tool(*tool);
    lock.lock();
  } else if (const auto* stop = std::get_if<interpreter::Stop>(&action.body)) {
    const bool is_optional = stop->kind == interpreter::StopKind::Optional;
    if (!is_optional || panel_.optional_stop) {
      stopped_at_ = stop->kind;
      stop_ = is_optional ? MachineState::OptionalStop : MachineState::ProgramStop;
      lock.unlock();
      sink_.on_stop(*stop);
      lock.lock();
    }
  } else if (const auto* end = std::get_if<interpreter::End>(&action.body)) {
    // The end of the last block comes first, so that the counter is complete.
    if (queue_.size() > 1 && !action.ends_block) {
      queue_.front().ends_block = queue_[1].ends_block;
      queue_.erase(queue_.begin() + 1);
    }
    (void)finish_front(lock);
    stop_ = MachineState::Completed;
    lock.unlock();
    sink_.on_end(*end);
    lock.lock();
    return false;
  }
  return finish_front(lock);
}

bool GrblMachine::finish_front(Lock& lock) {
  const Action& action = queue_.front();
  const Origin origin = action.origin;
  const bool ends_block = action.ends_block;
  const bool may_stop = action.may_stop_after;
  queued_seconds_ = queue_.size() == 1 ? 0 : std::max(0.0, queued_seconds_ - action.seconds);
  queue_.pop_front();
  if (next_ > 0) --next_;
  has_started_ = false;
  if (!ends_block) return true;
  executed_ = origin.block;
  origin_ = origin;
  if (is_single_block_ && may_stop && session_.is_empty() && stop_ == MachineState::Idle)
    stop_ = MachineState::SingleBlock;
  lock.unlock();
  sink_.on_block_executed(origin);
  lock.lock();
  return true;
}

void GrblMachine::discard() {
  queue_.clear();
  next_ = 0;
  queued_seconds_ = 0;
  is_released_ = has_started_ = false;
  (void)builder_.take();
  builder_.close();
}

void GrblMachine::deliver_alarm(Lock& lock, interpreter::Alarm alarm) {
  discard();
  stop_ = MachineState::Alarmed;
  lock.unlock();
  sink_.on_alarm(alarm);
  lock.lock();
}

/// True never: the program is over, or the board still brakes.
bool GrblMachine::end_abort(Lock& lock) {
  if (is_emergency_ || session_.is_stopping() || (session_.is_ready() && !session_.report()))
    return false;
  is_aborting_ = false;
  discard();
  stop_ = MachineState::Aborted;
  lock.unlock();
  sink_.on_aborted();
  lock.lock();
  return false;
}

// -- the owner's side ----------------------------------------------------------------------------

const MotionCapabilities& GrblMachine::capabilities() const {
  const Lock lock(mutex_);
  for (std::size_t i = 0; i < session_.board().axes(); ++i) capabilities_.axes.set(i);
  return capabilities_;
}

Result<void> GrblMachine::check_begin(const Position& at) const {
  const Lock lock(mutex_);
  if (auto ready = session_.check_ready(); !ready) return ready;
  const BoardInfo& board = session_.board();
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
  is_allowed_ = is_override_hold_ = false;
  is_aborting_ = is_emergency_;
  stop_ = MachineState::Idle;
  shown_ = {};
  origin_ = {};
  executed_ = 0;
  session_.set_active(false);
}

bool GrblMachine::has_room() const {
  const Lock lock(mutex_);
  return queue_.size() + builder_.size() < kMaxActions;
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
    const bool is_zero = panel_.feed_override == 0 || panel_.rapid_override == 0;
    if (is_zero && !is_override_hold_) {
      is_override_hold_ = true;
      if (!is_over()) session_.hold(now);
    } else if (!is_zero && is_override_hold_) {
      is_override_hold_ = false;
      (void)session_.resume(now);
    }
  }
  wake();
}

void GrblMachine::hold() {
  {
    const Lock lock(mutex_);
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
