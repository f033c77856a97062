#include "gateway/machine/grbl/motion_queue.hpp"

#include <cmath>
#include <utility>

namespace dripline::machine::grbl {

using interpreter::Origin;

void QueueBuilder::begin(LineWriter writer, const Coordinates& at) {
  writer_ = std::move(writer);
  writer_.begin(at);
  made_.clear();
  inhibit_ = {};
  spindle_ = {};
  tool_.reset();
  wants_tool_ = has_stopped_ = false;
  is_closed_ = false;
}

Action* QueueBuilder::add(const Origin& origin) {
  if (is_closed_) return nullptr;
  Action& action = made_.emplace_back();
  action.origin = origin;
  action.may_stop_after = !inhibit_.single_block;
  return &action;
}

void QueueBuilder::refuse(const Origin& origin, Refusal refusal) {
  Action* action = add(origin);
  if (!action) return;
  action->body =
      AlarmEvent{{.id = refusal.id, .text = std::move(refusal.text), .line = origin.line}};
  is_closed_ = true;
}

void QueueBuilder::add_motion(const Origin& origin, MotionKind kind, MotionText text,
                              std::optional<Refusal> refusal) {
  if (refusal) return refuse(origin, *std::move(refusal));
  if (text.lines.empty()) return;  // less than a step
  Action* action = add(origin);
  if (!action) return;
  action->seconds = text.seconds;
  action->body = Motion{.lines = std::move(text.lines), .end = text.end, .kind = kind};
}

/// The last moment to change a tool. False: nothing is taken.
bool QueueBuilder::begin_motion(const Origin& origin) {
  if (is_closed_) return false;
  stop_for_tool(origin);
  has_stopped_ = false;
  return true;
}

void QueueBuilder::want_tool() {
  wants_tool_ = !has_stopped_;
}

void QueueBuilder::stop_for_tool(const Origin& origin) {
  if (!std::exchange(wants_tool_, false) || is_closed_) return;
  const interpreter::Spindle before = spindle_;
  if (before.state != interpreter::SpindleState::Off) {
    interpreter::Spindle off;
    off.origin = origin;
    add_spindle(off);
  }
  if (Action* action = add(origin))
    action->body = interpreter::Stop{origin, interpreter::StopKind::ToolChange};
  has_stopped_ = true;
  if (before.state != interpreter::SpindleState::Off) add_spindle(before);
}

void QueueBuilder::on_rapid(const interpreter::Rapid& event) {
  if (!begin_motion(event.origin)) return;
  MotionText text;
  auto refusal = writer_.rapid(event, text);
  add_motion(event.origin, MotionKind::Rapid, std::move(text), std::move(refusal));
}

void QueueBuilder::on_line(const interpreter::Line& event) {
  if (!begin_motion(event.origin)) return;
  MotionText text;
  auto refusal = writer_.line(event, text);
  add_motion(event.origin, MotionKind::Line, std::move(text), std::move(refusal));
}

void QueueBuilder::on_arc(const interpreter::Arc& event) {
  if (!begin_motion(event.origin)) return;
  MotionText text;
  auto refusal = writer_.arc(event, text);
  const bool is_clockwise = event.turn == interpreter::Turn::Clockwise;
  add_motion(event.origin, is_clockwise ? MotionKind::Clockwise : MotionKind::Counterclockwise,
             std::move(text), std::move(refusal));
}

void QueueBuilder::on_thread(const interpreter::Thread& event) {
  refuse(event.origin, {"MCH0008", "this machine cannot cut threads"});
}

void QueueBuilder::on_dwell(const interpreter::Dwell& event) {
  if (event.revolutions)
    return refuse(event.origin, {"MCH0008", "this machine cannot dwell per revolution"});
  if (!std::isfinite(event.seconds))
    return refuse(event.origin, {"MCH0006", "the dwell has no finite length"});
  if (!(event.seconds > 0)) return;
  Action* action = add(event.origin);
  if (!action) return;
  action->seconds = event.seconds;
  action->body = BoardCommand{{LineWriter::dwell(event.seconds)}, event};
}

void QueueBuilder::on_spindle(const interpreter::Spindle& event) {
  if (wants_tool_ && event.state != interpreter::SpindleState::Off) {
    interpreter::Spindle off;
    off.origin = event.origin;
    if (spindle_.state != interpreter::SpindleState::Off) add_spindle(off);
    stop_for_tool(event.origin);
  }
  add_spindle(event);
}

void QueueBuilder::add_spindle(const interpreter::Spindle& event) {
  std::string line;
  if (auto refusal = writer_.spindle(event, line)) return refuse(event.origin, *std::move(refusal));
  spindle_ = event;
  if (Action* action = add(event.origin)) action->body = BoardCommand{{std::move(line)}, event};
}

void QueueBuilder::on_coolant(const interpreter::Coolant& event) {
  std::vector<std::string> lines;
  if (auto refusal = writer_.coolant(event, lines))
    return refuse(event.origin, *std::move(refusal));
  if (Action* action = add(event.origin)) action->body = BoardCommand{std::move(lines), event};
}

void QueueBuilder::on_tool(const interpreter::ToolChange& event) {
  if (Action* action = add(event.origin)) action->body = event;
  if (event.is_preselection || tool_ == event.number) return;
  tool_ = event.number;
  if (event.number != 0) want_tool();
}

/// A clamp or a chuck that is not switched is no detail.
void QueueBuilder::on_miscellaneous(const interpreter::Miscellaneous& event) {
  constexpr int kToolChange = 6;
  if (event.code == kToolChange) {
    if (Action* action = add(event.origin)) action->body = event;
    return want_tool();
  }
  refuse(event.origin, {"MCH0008", fmt::format("this machine cannot do M{}", event.code)});
}

void QueueBuilder::on_pin(const interpreter::PinChange& event) {
  refuse(event.origin,
         {"MCH0008", fmt::format("this machine cannot switch output {}", event.output)});
}

void QueueBuilder::on_stop(const interpreter::Stop& event) {
  const bool is_for_tool = event.kind == interpreter::StopKind::ToolChange;
  if (is_for_tool && has_stopped_) return;  // for this tool
  if (is_for_tool) wants_tool_ = false, has_stopped_ = true;
  if (Action* action = add(event.origin)) action->body = event;
}

void QueueBuilder::on_end(const interpreter::End& event) {
  if (Action* action = add(event.origin)) action->body = event;
}

void QueueBuilder::on_override_inhibit(const interpreter::OverrideInhibit& event) {
  if (event.is_tapping) return refuse(event.origin, {"MCH0008", "this machine cannot tap"});
  if (event.hold != interpreter::FeedHoldInhibit::AtOnce)
    return refuse(event.origin, {"MCH0008", "this machine cannot inhibit the feed hold"});
  const bool is_same = inhibit_.feed_override == event.feed_override &&
                       inhibit_.spindle_override == event.spindle_override;
  inhibit_ = event;
  if (is_same) return;
  if (Action* action = add(event.origin)) action->body = event;
}

void QueueBuilder::add_text(const Origin& origin, TextEvent text) {
  if (Action* action = add(origin)) action->body = std::move(text);
}

void QueueBuilder::on_output(const interpreter::Output& event) {
  add_text(
      event.origin,
      {.kind = TextEvent::Kind::Output, .device = event.device, .text = std::string(event.text)});
}

void QueueBuilder::on_open(const interpreter::Open& event) {
  add_text(event.origin, {.kind = event.name ? TextEvent::Kind::OpenNamed : TextEvent::Kind::Open,
                          .device = event.device,
                          .text = std::string(event.name.value_or(""))});
}

void QueueBuilder::on_close(const interpreter::Close& event) {
  add_text(event.origin, {.kind = TextEvent::Kind::Close, .device = event.device, .text = {}});
}

void QueueBuilder::on_message(const interpreter::Message& event) {
  add_text(event.origin, {.kind = TextEvent::Kind::Message, .text = std::string(event.text)});
}

void QueueBuilder::on_warning(const interpreter::Warning& event) {
  add_text(event.origin, {.kind = TextEvent::Kind::Warning,
                          .text = event.diagnostic.text,
                          .id = event.diagnostic.id,
                          .line = event.diagnostic.line,
                          .column = event.diagnostic.column});
}

void QueueBuilder::on_alarm(const interpreter::Alarm& event) {
  Action* action = add(event.origin);
  if (!action) return;
  action->body = AlarmEvent{event.diagnostic};
  is_closed_ = true;
}

void QueueBuilder::begin_probe(const interpreter::Probe& probe) {
  if (!begin_motion(probe.origin)) return;
  ProbeMove move{.probe = probe, .text = {}};
  move.probe.result.reset();
  if (auto refusal = writer_.probe(probe, move.text))
    return refuse(probe.origin, *std::move(refusal));
  Action* action = add(probe.origin);
  action->seconds = move.text.seconds;
  action->body = std::move(move);
}

void QueueBuilder::on_block_end(const Origin& origin) {
  if (is_closed_) return;
  stop_for_tool(origin);
  if (!made_.empty() && !made_.back().ends_block && made_.back().origin.block == origin.block) {
    made_.back().ends_block = true;
    made_.back().origin = origin;
    return;
  }
  if (Action* action = add(origin)) action->ends_block = true;
}

}  // namespace dripline::machine::grbl
