#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/grbl/grbl_machine.hpp"

/// The part of the machine that carries out a program's actions in order, and reports them.
namespace dripline::machine::grbl {

using interpreter::Axis;
using interpreter::Origin;

namespace {

constexpr std::size_t kLongestCommands = 64;      ///< bytes of one action's lines
constexpr std::chrono::seconds kCommandTime{30};  ///< a spindle may run up with its answer pending

/// Whether a straight move between the two passes `point`, within some steps.
bool is_on_path(const Coordinates& point, const Coordinates& from, const Coordinates& to) {
  constexpr double kSlack = 0.1;
  double square = 0, along = 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    square += (to[i] - from[i]) * (to[i] - from[i]);
    along += (to[i] - from[i]) * (point[i] - from[i]);
  }
  const double part = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (std::fabs(from[i] + (to[i] - from[i]) * part - point[i]) > kSlack) return false;
  return true;
}

}  // namespace

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
    if (!session_.may_send(kLongestCommands)) return false;
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
    if (!session_.may_send(move.text.lines.front().size() + LineWriter::kAdded)) return false;
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
    if (!is_on_path(end, expected_, move.text.end)) {
      session_.raise("GRB0007", "the board reports a contact that is not on the probe's path",
                     clock_->steady_now());
      return true;
    }
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
  if (const auto* function = std::get_if<interpreter::Miscellaneous>(&action.body)) {
    lock.unlock();
    sink_.on_miscellaneous(*function);
    lock.lock();
  } else if (const auto* tool = std::get_if<interpreter::ToolChange>(&action.body)) {
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
  report_off();
  sink_.on_aborted();
  lock.lock();
  return false;
}

}  // namespace dripline::machine::grbl
