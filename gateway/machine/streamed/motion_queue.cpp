#include "gateway/machine/streamed/motion_queue.hpp"

#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/machine/streamed/arc_path.hpp"

namespace dripline::machine::streamed {

using interpreter::Origin;

namespace {

GivenAction::Arc shape_of(const ArcPath& path) {
  return {.first = path.first,
          .second = path.second,
          .center_first = path.center_first,
          .center_second = path.center_second,
          .start_radius = path.start_radius,
          .end_radius = path.end_radius,
          .start = path.start,
          .sweep = path.sweep};
}

template <class Event>
Event on_axes(Event event, const ToolLengths& lengths) {
  event.to = plus(event.to, lengths);
  return event;
}

interpreter::Arc on_axes(interpreter::Arc arc, const ToolLengths& lengths) {
  const interpreter::PlaneAxes axes = axes_of(arc.plane);
  arc.to = plus(arc.to, lengths);
  arc.center_first += Length::mm(lengths[static_cast<std::size_t>(axes.first)]);
  arc.center_second += Length::mm(lengths[static_cast<std::size_t>(axes.second)]);
  return arc;
}

}  // namespace

void QueueBuilder::begin(const TextRules& rules, const Coordinates& at) {
  commands_->begin(rules);
  motion_ = MotionWriter(rules);
  motion_.begin(at);
  lengths_ = {};
  made_.clear();
  lines_ = 0;
  inhibit_ = {};
  refusal_.reset();
  is_closed_ = false;
}

Action* QueueBuilder::add(const Origin& origin) {
  if (is_closed_) return nullptr;
  if (!keeps_actions_) made_.clear();
  Action& action = made_.emplace_back();
  action.origin = origin;
  action.may_stop_after = !inhibit_.single_block;
  action.lengths = lengths_;
  return &action;
}

void QueueBuilder::refuse(const Origin& origin, Refusal refusal) {
  Action* action = add(origin);
  if (!action) return;
  refusal_ = {.id = refusal.id, .text = std::move(refusal.text), .line = origin.line};
  action->body = AlarmEvent{*refusal_};
  is_closed_ = true;
}

template <class Event>
void QueueBuilder::add_motion(const Event& event, MotionKind kind,
                              std::optional<Refusal> (MotionWriter::*write)(const Event&,
                                                                            MotionText&)) {
  if (is_closed_) return;
  MotionText text;
  const Coordinates from = motion_.at();
  if (auto refusal = (motion_.*write)(event, text))
    return refuse(event.origin, *std::move(refusal));
  if (text.lines.empty()) return;  // less than a step
  Action* action = add(event.origin);
  action->seconds = text.seconds;
  lines_ += text.lines.size();
  action->body = Motion{.lines = std::move(text.lines),
                        .from = from,
                        .end = text.end,
                        .length = text.length,
                        .kind = kind};
}

template <class Event>
void QueueBuilder::add_command(const Event& event, std::optional<Refusal> (CommandWriter::*write)(
                                                       const Event&, CommandWriter::Lines&)) {
  if (is_closed_) return;
  CommandWriter::Lines lines;
  if (auto refusal = ((*commands_).*write)(event, lines))
    return refuse(event.origin, *std::move(refusal));
  add(event.origin)->body = Command{std::move(lines), event};
}

void QueueBuilder::on_rapid(const interpreter::Rapid& event) {
  add_motion(on_axes(event, lengths_), MotionKind::Rapid, &MotionWriter::rapid);
}

void QueueBuilder::on_line(const interpreter::Line& event) {
  add_motion(on_axes(event, lengths_), MotionKind::Line, &MotionWriter::line);
}

void QueueBuilder::on_arc(const interpreter::Arc& given) {
  const interpreter::Arc event = on_axes(given, lengths_);
  const bool is_clockwise = event.turn == interpreter::Turn::Clockwise;
  const Coordinates from = motion_.at();
  const std::size_t before = made_.size();
  add_motion(event, is_clockwise ? MotionKind::Clockwise : MotionKind::Counterclockwise,
             &MotionWriter::arc);
  if (made_.size() == before) return;
  auto* motion = std::get_if<Motion>(&made_.back().body);
  if (motion != nullptr) motion->arc = shape_of(arc_path(from, motion->end, event));
}

void QueueBuilder::on_thread(const interpreter::Thread& event) {
  refuse(event.origin, {"MCH0008", "this machine cannot cut threads"});
}

void QueueBuilder::on_dwell(const interpreter::Dwell& event) {
  if (event.revolutions)
    return refuse(event.origin, {"MCH0008", "this machine cannot dwell per revolution"});
  CommandWriter::Lines lines;
  if (auto refusal = motion_.dwell(event.seconds, lines))
    return refuse(event.origin, *std::move(refusal));
  if (lines.empty()) return;
  Action* action = add(event.origin);
  if (!action) return;
  action->seconds = event.seconds;
  action->body = Command{std::move(lines), event};
}

void QueueBuilder::on_spindle(const interpreter::Spindle& event) {
  add_command(event, &CommandWriter::spindle);
}

void QueueBuilder::on_coolant(const interpreter::Coolant& event) {
  add_command(event, &CommandWriter::coolant);
}

void QueueBuilder::on_tool(const interpreter::ToolChange& event) {
  add_command(event, &CommandWriter::tool);
}

void QueueBuilder::on_miscellaneous(const interpreter::Miscellaneous& event) {
  add_command(event, event.is_done ? &CommandWriter::done_function : &CommandWriter::miscellaneous);
}

void QueueBuilder::on_pin(const interpreter::PinChange& event) {
  add_command(event, &CommandWriter::pin);
}

void QueueBuilder::on_stop(const interpreter::Stop& event) {
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
  if (is_closed_) return;
  ProbeMove move{.probe = probe, .text = {}};
  move.probe.result.reset();
  if (auto refusal = motion_.probe(on_axes(probe, lengths_), move.text))
    return refuse(probe.origin, *std::move(refusal));
  Action* action = add(probe.origin);
  action->seconds = move.text.seconds;
  action->body = std::move(move);
}

void QueueBuilder::on_block_end(const Origin& origin) {
  if (is_closed_) return;
  if (!made_.empty() && !made_.back().ends_block && made_.back().origin.block == origin.block) {
    made_.back().ends_block = true;
    made_.back().lengths = lengths_;
    made_.back().origin = origin;
    return;
  }
  if (Action* action = add(origin)) action->ends_block = true;
}

}  // namespace dripline::machine::streamed
