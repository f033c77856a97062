#include "clients/tools/comparison/action_recorder.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::comparison {

namespace {

/// Of what was compared; more than this many actions in front are given back.
constexpr std::size_t kMaxDropped = 8192;

}  // namespace

void ActionQueue::drop(std::size_t count) {
  head_ += count;
  if (head_ == tail_) {
    head_ = tail_ = 0;
  } else if (head_ > kMaxDropped && head_ > tail_ / 2) {
    std::rotate(actions_.begin(), actions_.begin() + static_cast<std::ptrdiff_t>(head_),
                actions_.begin() + static_cast<std::ptrdiff_t>(tail_));
    tail_ -= head_;
    head_ = 0;
  }
}

Action& ActionQueue::push() {
  if (tail_ == actions_.size()) actions_.emplace_back();
  Action& action = actions_[tail_++];
  action = Action{};
  return action;
}

Action& ActionRecorder::push(ActionKind kind, const interpreter::Origin& origin) {
  Action& action = queue_.push();
  action.kind = kind;
  action.place = {origin.line, origin.offset, origin.program};
  return action;
}

Action& ActionRecorder::move(ActionKind kind, const interpreter::Origin& origin,
                             const interpreter::Position& to) {
  Action& action = push(kind, origin);
  action.from = at_;
  action.to = to;
  if (interpreter_ != nullptr) action.lengths = interpreter_->modes().lengths();
  is_cutting_ = kind != ActionKind::Rapid;
  is_reversed_ = is_reversed_ && is_cutting_;
  const bool is_in_step = is_feed_fixed_ || is_reversed_ || kind == ActionKind::Thread;
  if (is_cutting_ && is_in_step) set_in_step(action);
  at_ = to;
  return action;
}

void ActionRecorder::set_in_step(Action& move) const {
  move.is_in_step = true;
  if (!is_spindle_known_) return;
  const bool is_by_surface = spindle_.numbers[1] != Action::kNoNumber;
  move.speed = spindle_.numbers[is_by_surface ? 1 : 0];
}

/// A tap comes out of its hole with the spindle reversed, whatever wrote that: a cycle or blocks.
void ActionRecorder::note_turn(interpreter::SpindleState state) {
  if (!interpreter::is_turning(state)) return;
  is_reversed_ = is_reversed_ || (is_cutting_ && turn_ && *turn_ != state);
  turn_ = state;
}

void ActionRecorder::on_rapid(const interpreter::Rapid& event) {
  if (event.to.same_point(at_)) return;
  move(ActionKind::Rapid, event.origin, event.to).rests = event.rests;
}

void ActionRecorder::on_line(const interpreter::Line& event) {
  if (event.to.same_point(at_)) return;
  Action& action = move(ActionKind::Line, event.origin, event.to);
  action.rests = event.rests;
  action.feed = event.feed;
}

void ActionRecorder::set_arc(Action& action, const interpreter::Arc& arc) {
  action.has_arc = true;
  action.plane = arc.plane;
  action.turn = arc.turn;
  action.center = {arc.center_first.mm(), arc.center_second.mm()};
  action.sweep = arc.sweep.radians();
}

void ActionRecorder::on_arc(const interpreter::Arc& event) {
  Action& action = move(ActionKind::Arc, event.origin, event.to);
  set_arc(action, event);
  action.rests = event.rests;
  action.feed = event.feed;
}

void ActionRecorder::on_thread(const interpreter::Thread& event) {
  Action& action = move(ActionKind::Thread, event.origin, event.to);
  if (event.arc) set_arc(action, arc_of(event));
  action.feed = {};
  action.numbers = {event.lead.mm(), event.lead_change.mm(),
                    event.start_angle ? event.start_angle->degrees() : Action::kNoNumber};
}

void ActionRecorder::on_probe(const interpreter::Probe& event) {
  if (!event.result) return;
  Action& action = push(ActionKind::Probe, event.origin);
  action.from = event.from;
  action.to = event.to;
  action.feed = event.feed;
  action.code = static_cast<int>(event.until);
  if (event.arc) {
    interpreter::Probe programmed = event;
    programmed.result.reset();
    set_arc(action, arc_of(programmed));
  }
  if (interpreter_ != nullptr) action.lengths = interpreter_->modes().lengths();
  at_ = event.result->at;
}

void ActionRecorder::on_dwell(const interpreter::Dwell& event) {
  push(ActionKind::Dwell, event.origin).numbers = {
      event.revolutions ? 0 : event.seconds, event.revolutions.value_or(Action::kNoNumber), 0};
}

/// A state that is in force is not an action of its own across controls: some report it again with
/// each tool or block.
bool ActionRecorder::is_repeated(const Action& state, Action& last, bool& is_known) {
  const bool is_same = is_known && state.code == last.code && state.numbers == last.numbers;
  last = state;
  is_known = true;
  return is_same && across_controls_;
}

void ActionRecorder::on_spindle(const interpreter::Spindle& event) {
  note_turn(event.state);
  Action& action = push(ActionKind::Spindle, event.origin);
  action.code = static_cast<int>(event.state);
  action.numbers = {event.surface_speed ? 0 : event.revolutions_per_minute,
                    event.surface_speed ? event.surface_speed->mm() : Action::kNoNumber,
                    event.max_revolutions.value_or(Action::kNoNumber)};
  // Some controls still report the speed of a spindle that they switch off.
  if (event.state == interpreter::SpindleState::Off) action.numbers = {};
  if (is_repeated(action, spindle_, is_spindle_known_)) return queue_.drop_back();
  if (across_controls_ && queue_.size() > 1 &&
      queue_[queue_.size() - 2].kind == ActionKind::Coolant)
    queue_.swap_last_two();
}

void ActionRecorder::on_coolant(const interpreter::Coolant& event) {
  Action& action = push(ActionKind::Coolant, event.origin);
  action.code = (event.flood ? 1 : 0) | (event.mist ? 2 : 0);
  if (is_repeated(action, coolant_, is_coolant_known_)) queue_.drop_back();
}

void ActionRecorder::on_tool(const interpreter::ToolChange& event) {
  if (event.is_preselection && across_controls_) return;
  Action& action = push(ActionKind::Tool, event.origin);
  action.code = event.number;
  action.offset = event.offset;
  action.numbers[0] = event.is_preselection ? 1 : event.is_in_spindle ? 2 : 0;
}

void ActionRecorder::on_miscellaneous(const interpreter::Miscellaneous& event) {
  Action& action = push(ActionKind::Function, event.origin);
  action.code = event.code;
  action.numbers = {event.p.value_or(Action::kNoNumber), event.q.value_or(Action::kNoNumber),
                    event.e.value_or(Action::kNoNumber)};
}

void ActionRecorder::on_pin(const interpreter::PinChange& event) {
  Action& action = push(ActionKind::Pin, event.origin);
  action.code = event.output;
  action.numbers = {event.state ? 1.0 : 0.0, event.pulse_ms.value_or(Action::kNoNumber),
                    static_cast<double>(event.axis)};
}

void ActionRecorder::on_output(const interpreter::Output& event) {
  Action& action = push(ActionKind::Output, event.origin);
  action.code = static_cast<int>(event.device);
  action.text = event.text;
}

void ActionRecorder::on_open(const interpreter::Open& event) {
  Action& action = push(ActionKind::Output, event.origin);
  action.code = static_cast<int>(event.device);
  action.numbers[0] = 1;
  action.text = event.name.value_or("");
}

void ActionRecorder::on_close(const interpreter::Close& event) {
  Action& action = push(ActionKind::Output, event.origin);
  action.code = static_cast<int>(event.device);
  action.numbers[0] = 2;
}

void ActionRecorder::on_message(const interpreter::Message& event) {
  push(ActionKind::Message, event.origin).text = event.text;
}

void ActionRecorder::on_prompt(const interpreter::Prompt& event) {
  push(ActionKind::Message, event.origin).text =
      fmt::format("{} {} = {}", event.text, event.variable, event.answer);
}

void ActionRecorder::on_stop(const interpreter::Stop& event) {
  push(ActionKind::Stop, event.origin).code = static_cast<int>(event.kind);
}

void ActionRecorder::on_override_inhibit(const interpreter::OverrideInhibit& event) {
  is_feed_fixed_ = event.feed_override;
  if (across_controls_) return;
  push(ActionKind::Inhibit, event.origin).code =
      (event.feed_override ? 1 : 0) | (event.spindle_override ? 2 : 0) |
      (event.single_block ? 4 : 0) | (event.is_tapping ? 8 : 0) | static_cast<int>(event.hold) << 4;
}

void ActionRecorder::on_alarm(const interpreter::Alarm& event) {
  Action& action = push(ActionKind::Alarm, event.origin);
  action.place.line = event.diagnostic.line;
  alarm_offset_ = event.origin.offset;
  action.text = event.diagnostic.id;
}

/// Across controls: what the end itself switches off belongs to the control.
void ActionRecorder::on_end(const interpreter::End& event) {
  const auto is_of_end = [&event](const Action& action) {
    return (action.kind == ActionKind::Spindle || action.kind == ActionKind::Coolant) &&
           action.place.line == event.origin.line && action.place.program == event.origin.program;
  };
  while (across_controls_ && !queue_.empty() && is_of_end(queue_.back())) queue_.drop_back();
  push(ActionKind::End, event.origin).code = event.rewind ? 1 : 0;
}

}  // namespace dripline::comparison
