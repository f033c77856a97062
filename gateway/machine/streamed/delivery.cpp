// What the device has executed becomes calls of the sink, action by action.
#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/streamed/streamed_machine.hpp"

namespace dripline::machine::streamed {

using interpreter::Origin;

namespace {

constexpr std::chrono::seconds kCommandTime{30};  ///< a spindle may run up meanwhile

enum class Place : std::uint8_t { Elsewhere, OnPath, End };

/// Every point of a path is at most its length from both of its ends together; for a straight move
/// there are no others. An arc may pass its end before it is there.
Place place_on(const Motion& motion, const Coordinates& at) {
  constexpr double kSlack = 0.01;  // the device's own rounding and arc tolerance
  const double to_end = distance(at, motion.end);
  if (distance(motion.from, at) + to_end > motion.length + kSlack) return Place::Elsewhere;
  const bool is_straight = distance(motion.from, motion.end) > motion.length - kSlack / 2;
  return is_straight && motion.length > kSlack && to_end < kSlack / 2 ? Place::End : Place::OnPath;
}

}  // namespace

/// The sink is called without the mutex: a hold must not wait for a disk.
template <class Call>
void StreamedMachine::tell(Lock& lock, const Call& call) {
  lock.unlock();
  call(sink_);
  lock.lock();
}

bool StreamedMachine::is_over() const {
  return stop_ == MachineState::Completed || stop_ == MachineState::Alarmed ||
         stop_ == MachineState::Aborted;
}

bool StreamedMachine::may_begin() const {
  return stop_ == MachineState::Idle && is_allowed_ && !is_aborting_ && !is_emergency_ &&
         !is_override_hold_ && !device_.is_held() && !device_.fault();
}

void StreamedMachine::take_made() {
  for (Action& action : builder_.take()) {
    queued_seconds_ += action.seconds;
    if (const auto* motion = std::get_if<Motion>(&action.body))
      queued_lines_ += motion->lines.size();
    queue_.push_back(std::move(action));
  }
}

Seconds StreamedMachine::poll(Seconds, std::size_t max_actions) {
  {
    Lock lock(mutex_);
    take_made();
    is_allowed_ = max_actions > 0;
    const bool has_program = is_active_ || is_allowed_;  // not while it waits for cycle start
    set_active(has_program && !is_over());
    do {
      announce(lock);
    } while (deliver(lock));
    pump(lock);
    set_active(has_program && !is_over());
  }
  report_off();
  wake();
  return Seconds{0};
}

/// False: nothing more can be delivered now.
bool StreamedMachine::deliver(Lock& lock) {
  if (is_over()) return false;
  const auto& fault = device_.fault();
  if (fault || is_aborting_) {
    if (deliver_executed(lock)) return true;
    if (device_.is_stopping()) return false;  // it still reports how far it comes
  }
  if (fault) {
    const Origin origin = origin_;
    deliver_alarm(lock, {origin, {.id = fault->id, .text = fault->text, .line = origin.line}});
    return false;
  }
  if (is_aborting_) {
    if (deliver_passed(lock)) return true;
    end_abort(lock);
    return false;
  }
  return !queue_.empty() && deliver_front(lock);
}

/// What was executed before the device has stopped.
bool StreamedMachine::deliver_executed(Lock& lock) {
  if (queue_.empty()) return false;
  const auto* motion = std::get_if<Motion>(&queue_.front().body);
  const bool is_executed = motion != nullptr && motion->sent == motion->lines.size() &&
                           motion->last_serial > 0 && device_.executed() >= motion->last_serial;
  const bool is_end = is_released_ && std::holds_alternative<BlockEnd>(queue_.front().body);
  return (is_executed || is_end) && finish_front(lock);
}

/// With the axes at rest after an abort: motion that they have passed, though no report had shown
/// it yet. Where a path crosses itself, the first place counts: nothing is claimed that was not
/// done.
bool StreamedMachine::deliver_passed(Lock& lock) {
  if (!device_.is_at_rest() || !is_released_) return false;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const auto* motion = std::get_if<Motion>(&queue_[i].body);
    if (motion == nullptr && !std::holds_alternative<BlockEnd>(queue_[i].body)) return false;
    if (motion == nullptr) continue;
    if (motion->sent == 0) return false;
    const Place place = place_on(*motion, device_.position());
    if (place == Place::Elsewhere) continue;
    const bool is_passed = place == Place::End && motion->sent == motion->lines.size();
    return (i > 0 || is_passed) && finish_front(lock);
  }
  return false;
}

bool StreamedMachine::deliver_front(Lock& lock) {
  Action& action = queue_.front();
  if (std::holds_alternative<BlockEnd>(action.body)) {
    origin_ = action.origin;
    return finish_front(lock);
  }
  if (std::holds_alternative<Motion>(action.body)) return deliver_motion(lock);
  if (!may_begin()) return false;
  if (!device_.is_empty()) {
    device_.await_execution();
    return false;
  }
  is_released_ = false;
  origin_ = action.origin;
  if (std::holds_alternative<Command>(action.body)) return deliver_command(lock);
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

/// The last moment to write what was reported before the motion. False: it cannot be written, and
/// nothing begins. At the end of an inhibit a device needs some time for the operator's overrides.
bool StreamedMachine::start_front(Lock& lock) {
  if (!device_.has_overrides()) return false;
  const Origin origin = origin_;
  bool may_start = false;
  tell(lock, [&](ExecutionSink& sink) { may_start = sink.on_motion_starts(origin); });
  has_started_ = may_start;
  return has_started_;
}

bool StreamedMachine::deliver_motion(Lock& lock) {
  Action& action = queue_.front();
  auto& motion = std::get<Motion>(action.body);
  origin_ = action.origin;
  shown_.motion = motion.kind;
  if (!is_released_) {
    if (!may_begin()) return false;
    if (!has_started_) return start_front(lock);  // meanwhile a fault may have come
    is_released_ = true;
    pump(lock);
  }
  shown_.lengths = action.lengths;
  const bool is_executed =
      motion.sent == motion.lines.size() && device_.executed() >= motion.last_serial;
  if (!is_executed) return false;
  if (device_.is_empty() && next_ <= 1 && device_.is_at_rest() && !check_position(motion.end))
    return true;  // to the fault
  return finish_front(lock);
}

namespace {

constexpr std::string_view kMovedByCommand =
    ": a tool change or a function of the machine has moved the axes. Move them there before it, "
    "or let it bring them back";

/// A tool change may go to a place of its own, and the builder's functions may do anything.
bool may_have_moved(const Command& command) {
  if (command.lines.empty()) return false;
  const auto* tool = std::get_if<interpreter::ToolChange>(&command.event);
  return (tool != nullptr && !tool->is_preselection) ||
         std::holds_alternative<interpreter::Miscellaneous>(command.event);
}

}  // namespace

bool StreamedMachine::deliver_command(Lock& lock) {
  auto& command = std::get<Command>(queue_.front().body);
  if (command.sent < command.lines.size()) {
    if (!has_started_) return start_front(lock);
    if (!has_begun_ && !check_position(expected_)) return device_.fault().has_value();
    has_begun_ = true;
    if (!device_.prepare(now())) return false;
    const auto* dwell = std::get_if<interpreter::Dwell>(&command.event);
    for (; command.sent < command.lines.size(); ++command.sent) {
      const std::string& line = command.lines[command.sent];
      if (!device_.may_send(line.size())) return false;
      const auto time = dwell ? std::chrono::milliseconds(std::llround(dwell->seconds * 1000))
                              : std::chrono::milliseconds(kCommandTime);
      device_.send(line, false, time);
    }
    device_.await_execution();
    return false;
  }
  if (may_have_moved(command) && !check_position(expected_, kMovedByCommand))
    return device_.fault().has_value();
  const Command done = command;
  report(lock, done);
  return finish_front(lock);
}

void StreamedMachine::report(Lock& lock, const Command& command) {
  if (const auto* spindle = std::get_if<interpreter::Spindle>(&command.event)) {
    shown_.spindle = *spindle;
    tell(lock, [&](ExecutionSink& sink) { sink.on_spindle(*spindle); });
  } else if (const auto* coolant = std::get_if<interpreter::Coolant>(&command.event)) {
    shown_.flood = coolant->flood;
    shown_.mist = coolant->mist;
    tell(lock, [&](ExecutionSink& sink) { sink.on_coolant(*coolant); });
  } else if (const auto* tool = std::get_if<interpreter::ToolChange>(&command.event)) {
    shown_.next_tool.reset();
    (tool->is_preselection ? shown_.next_tool : shown_.tool) = tool->number;
    if (tool->offset) shown_.tool_offset = tool->offset;
    tell(lock, [&](ExecutionSink& sink) { sink.on_tool(*tool); });
  } else if (const auto* code = std::get_if<interpreter::Miscellaneous>(&command.event)) {
    tell(lock, [&](ExecutionSink& sink) { sink.on_miscellaneous(*code); });
  } else if (const auto* pin = std::get_if<interpreter::PinChange>(&command.event)) {
    tell(lock, [&](ExecutionSink& sink) { sink.on_pin(*pin); });
  }
}

bool StreamedMachine::deliver_text(Lock& lock) {
  const TextEvent text = std::get<TextEvent>(queue_.front().body);
  const Origin origin = origin_;
  tell(lock, [&](ExecutionSink& sink) {
    switch (text.kind) {
      case TextEvent::Kind::Output:
        return sink.on_output({origin, text.device, text.text});
      case TextEvent::Kind::Open:
        return sink.on_open({origin, text.device, std::nullopt});
      case TextEvent::Kind::OpenNamed:
        return sink.on_open({origin, text.device, text.text});
      case TextEvent::Kind::Close:
        return sink.on_close({origin, text.device});
      case TextEvent::Kind::Message:
        return sink.on_message({origin, text.text});
      case TextEvent::Kind::Warning:
        return sink.on_warning({origin, {text.id, text.text, text.line, text.column}});
    }
  });
  return finish_front(lock);
}

/// Stops and the end.
bool StreamedMachine::deliver_stop(Lock& lock) {
  const Action action = queue_.front();
  if (const auto* stop = std::get_if<interpreter::Stop>(&action.body)) {
    const bool is_optional = stop->kind == interpreter::StopKind::Optional;
    if (!is_optional || panel_.optional_stop) {
      stopped_at_ = stop->kind;
      stop_ = is_optional ? MachineState::OptionalStop : MachineState::ProgramStop;
      tell(lock, [&](ExecutionSink& sink) { sink.on_stop(*stop); });
    }
  } else if (const auto* end = std::get_if<interpreter::End>(&action.body)) {
    if (!device_.finish(now())) return false;
    // The end of the last block comes first, so that the counter is complete.
    if (queue_.size() > 1 && !action.ends_block) {
      queue_.front().ends_block = queue_[1].ends_block;
      queue_.erase(queue_.begin() + 1);
    }
    (void)finish_front(lock);
    stop_ = MachineState::Completed;
    tell(lock, [&](ExecutionSink& sink) { sink.on_end(*end); });
    return false;
  }
  return finish_front(lock);
}

bool StreamedMachine::finish_front(Lock& lock) {
  const Action& action = queue_.front();
  const Origin origin = action.origin;
  const bool ends_block = action.ends_block;
  const bool may_stop = action.may_stop_after;
  const double seconds = action.seconds;
  shown_.lengths = action.lengths;
  queued_seconds_ = queue_.size() == 1 ? 0 : std::max(0.0, queued_seconds_ - action.seconds);
  if (const auto* motion = std::get_if<Motion>(&action.body)) queued_lines_ -= motion->lines.size();
  queue_.pop_front();
  if (next_ > 0) --next_;
  if (announced_ > 0) --announced_, announced_seconds_ -= seconds;
  if (announced_ == 0) announced_seconds_ = 0;
  has_started_ = false;
  if (!ends_block) return true;
  executed_ = origin.block;
  origin_ = origin;
  if (is_single_block_ && may_stop && device_.is_empty() && stop_ == MachineState::Idle)
    stop_ = MachineState::SingleBlock;
  tell(lock, [&](ExecutionSink& sink) { sink.on_block_executed(origin); });
  return true;
}

void StreamedMachine::discard() {
  queue_.clear();
  next_ = announced_ = 0;
  announced_seconds_ = 0;
  queued_seconds_ = 0;
  queued_lines_ = 0;
  ahead_.clear();
  is_released_ = has_started_ = false;
  (void)builder_.take();
  builder_.close();
}

void StreamedMachine::deliver_alarm(Lock& lock, const interpreter::Alarm& alarm) {
  discard();
  if (!device_.fault()) device_.switch_off();
  is_off_due_ = true;
  stop_ = MachineState::Alarmed;
  lock.unlock();
  report_off();
  sink_.on_alarm(alarm);
  lock.lock();
}

void StreamedMachine::end_abort(Lock& lock) {
  if (is_emergency_) return;
  is_aborting_ = false;
  is_off_due_ = true;
  discard();
  stop_ = MachineState::Aborted;
  lock.unlock();
  report_off();
  sink_.on_aborted();
  lock.lock();
}

}  // namespace dripline::machine::streamed
