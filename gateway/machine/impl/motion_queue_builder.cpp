#include "gateway/machine/impl/motion_queue_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dripline::machine::impl {

using interpreter::Origin;

namespace {

constexpr std::size_t kLongestWarning = 4096;

}  // namespace

MotionQueueBuilder::MotionQueueBuilder(const MachineLimits& limits, ActionQueue& queue)
    : queue_(queue), builder_(limits), spindle_(limits.spindle) {}

void MotionQueueBuilder::begin(const Coordinates& at) {
  end_ = at;
  lock_ = {};
  spindle_.stop();
  builder_.drop_direction();
  is_closed_ = false;
  text_block_ = block_text_ = largest_text_ = 0;
}

Action* MotionQueueBuilder::add(const Origin& origin) {
  if (is_closed_) return nullptr;
  if (queue_.size() + 1 < queue_.capacity()) {
    Action& action = queue_.push(origin);
    action.lock = lock_;
    return &action;
  }
  alarm(origin, "MCH0005", "one block asks for more actions than the machine can queue");
  return nullptr;
}

void MotionQueueBuilder::alarm(const Origin& origin, std::string_view id, std::string text) {
  add_alarm(origin, {.id = id, .text = std::move(text), .line = origin.line});
}

void MotionQueueBuilder::add_alarm(const Origin& origin, interpreter::Diagnostic diagnostic) {
  if (is_closed_) return;
  queue_.push(origin).body.emplace<AlarmMarker>();  // the last place is kept free for this
  queue_.alarm = std::move(diagnostic);
  is_closed_ = true;
}

template <class Event>
void MotionQueueBuilder::add_as_is(const Event& event) {
  if (Action* action = add(event.origin)) action->body.emplace<Event>(event);
}

void MotionQueueBuilder::add_straight(const Origin& origin, const interpreter::Position& to,
                                      MoveTask task) {
  Coordinates target = end_;
  take_over(target, to);
  if (target == end_) return;
  task.path = straight_path(end_, target);
  if (task.path.length == 0) return;  // so short that its square is 0
  add_move(origin, task);
}

void MotionQueueBuilder::add_move(const Origin& origin, const MoveTask& task) {
  Action* action = add(origin);
  if (!action) return;
  auto& move = action->body.emplace<Move>();
  if (auto refusal = builder_.build(task, spindle_, move)) {
    queue_.drop_back();
    return alarm(origin, refusal->id, std::move(refusal->text));
  }
  if (move.pace == Pace::Thread) action->lock.hold = interpreter::FeedHoldInhibit::Later;
  queue_.set_seconds(*action, move.path.length / std::min(move.speed, move.ceiling));
  end_ = task.path.to;
}

void MotionQueueBuilder::on_rapid(const interpreter::Rapid& event) {
  add_straight(event.origin, event.to, {.path = {}, .pace = Pace::Rapid, .feed = {}, .lead = {}});
  if (event.rests) builder_.drop_direction();
}

void MotionQueueBuilder::on_line(const interpreter::Line& event) {
  add_straight(event.origin, event.to,
               {.path = {}, .pace = Pace::Feed, .feed = event.feed, .lead = {}});
  if (event.rests) builder_.drop_direction();
}

void MotionQueueBuilder::on_thread(const interpreter::Thread& event) {
  MoveTask task{.path = {}, .pace = Pace::Thread, .feed = {}, .lead = {}};
  if (event.arc) {
    task.path = arc_path(end_, interpreter::arc_of(event));
    if (!task.path.is_arc() || !(task.path.length > 0))
      return alarm(event.origin, "MCH0006", "the arc has no radius or no length");
  } else {
    Coordinates target = end_;
    take_over(target, event.to);
    task.path = straight_path(end_, target);
    if (!(task.path.length > 0)) return;
  }
  task.lead = abs(interpreter::mean_lead(event, Length::mm(task.path.length)));
  add_move(event.origin, task);
}

void MotionQueueBuilder::on_arc(const interpreter::Arc& event) {
  const Path path = arc_path(end_, event);
  if (!path.is_arc() || !(path.length > 0))
    return alarm(event.origin, "MCH0006", "the arc has no radius or no length");
  add_move(event.origin, {.path = path, .pace = Pace::Feed, .feed = event.feed, .lead = {}});
  if (event.rests) builder_.drop_direction();
}

void MotionQueueBuilder::on_dwell(const interpreter::Dwell& event) {
  Wait wait{.seconds = event.seconds, .follows_spindle = event.revolutions.has_value()};
  if (event.revolutions) {
    const double rpm = spindle_.mean_rpm(end_[0], end_[0]);
    if (!(rpm > 0))
      return alarm(event.origin, "MCH0004", "a dwell of revolutions with the spindle stopped");
    wait.seconds = *event.revolutions / rpm * 60;
  }
  if (!std::isfinite(wait.seconds))
    return alarm(event.origin, "MCH0006", "the dwell has no finite length");
  if (wait.seconds < 0) wait.seconds = 0;
  Action* action = add(event.origin);
  if (!action) return;
  action->body = wait;
  queue_.set_seconds(*action, wait.seconds);
}

void MotionQueueBuilder::on_spindle(const interpreter::Spindle& event) {
  add_as_is(event);
  spindle_.set(event);
}

void MotionQueueBuilder::on_coolant(const interpreter::Coolant& event) {
  if (Action* action = add(event.origin))
    action->body = CoolantChange{.flood = event.flood, .mist = event.mist};
}

void MotionQueueBuilder::on_tool(const interpreter::ToolChange& event) {
  add_as_is(event);
}
void MotionQueueBuilder::on_miscellaneous(const interpreter::Miscellaneous& event) {
  add_as_is(event);
}
void MotionQueueBuilder::on_pin(const interpreter::PinChange& event) {
  add_as_is(event);
}
void MotionQueueBuilder::on_stop(const interpreter::Stop& event) {
  add_as_is(event);
}
void MotionQueueBuilder::on_end(const interpreter::End& event) {
  add_as_is(event);
}

void MotionQueueBuilder::add_text(const Origin& origin, Text text, std::string_view content) {
  if (is_closed_) return;
  if (std::exchange(text_block_, origin.block) != origin.block) block_text_ = 0;
  block_text_ += content.size();
  largest_text_ = std::max(largest_text_, block_text_);
  const auto piece = queue_.texts().push(content);
  if (!piece)
    return alarm(origin, "MCH0005", "one block puts out more text than the machine can queue");
  Action* action = add(origin);
  if (!action) return;  // the alarm clears the queue and frees the text
  text.piece = *piece;
  action->body = text;
}

void MotionQueueBuilder::on_output(const interpreter::Output& event) {
  Text text;
  text.device = event.device;
  add_text(event.origin, text, event.text);
}

void MotionQueueBuilder::on_open(const interpreter::Open& event) {
  Text text;
  text.kind = event.name ? Text::Kind::OpenNamed : Text::Kind::Open;
  text.device = event.device;
  add_text(event.origin, text, event.name.value_or(""));
}

void MotionQueueBuilder::on_close(const interpreter::Close& event) {
  if (Action* action = add(event.origin)) action->body = CloseDevice{event.device};
}

void MotionQueueBuilder::on_message(const interpreter::Message& event) {
  Text text;
  text.kind = Text::Kind::Message;
  add_text(event.origin, text, event.text);
}

void MotionQueueBuilder::on_warning(const interpreter::Warning& event) {
  Text text;
  text.kind = Text::Kind::Warning;
  text.id = event.diagnostic.id;
  text.line = event.diagnostic.line;
  text.column = event.diagnostic.column;
  add_text(event.origin, text, std::string_view{event.diagnostic.text}.substr(0, kLongestWarning));
}

void MotionQueueBuilder::on_alarm(const interpreter::Alarm& event) {
  add_alarm(event.origin, event.diagnostic);
}

void MotionQueueBuilder::on_block_end(const Origin& origin) {
  if (is_closed_) return;
  if (!queue_.empty()) {
    Action& last = queue_.back();
    if (!last.ends_block && last.origin.block == origin.block) {
      last.ends_block = true;
      last.lock.single_block = lock_.single_block;
      last.origin = origin;
      return;
    }
  }
  if (Action* action = add(origin)) {
    action->body.emplace<BlockEnd>();
    action->ends_block = true;
  }
}

void MotionQueueBuilder::begin_probe(const interpreter::Probe& probe) {
  Action* action = add(probe.origin);
  if (!action) return;
  action->body.emplace<ProbeMarker>();
  queue_.probe = probe;
  queue_.probe->result.reset();
}

void MotionQueueBuilder::end_probe(const Coordinates& at) {
  end_ = at;
  builder_.drop_direction();
}

}  // namespace dripline::machine::impl
