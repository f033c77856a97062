#include "gateway/interpreter/dialects/centurion/cycles/pattern_recorder.hpp"

namespace dripline::interpreter::centurion {
namespace {

PatternMove move_of(PatternMove::Kind kind, const Origin& origin) {
  PatternMove move;
  move.kind = kind;
  move.line = origin.line;
  move.sequence = origin.sequence;
  return move;
}

PlanePoint point_of(const Position& at) {
  return {at.raw(Axis::X), at.raw(Axis::Z)};
}

void set_feed(PatternMove& move, const Feed& feed) {
  move.is_feed_per_revolution = feed.per() == Feed::Per::Revolution;
  move.feed = feed.length().mm();
}

}  // namespace

void PatternRecorder::refuse(PatternFault fault) {
  if (state_.pattern.fault == PatternFault::None) state_.pattern.fault = fault;
}

void PatternRecorder::record(const PatternMove& move) {
  if (state_.pattern.moves.size() == kMaxPatternMoves) return refuse(PatternFault::TooManyMoves);
  state_.pattern.moves.push_back(move);
}

void PatternRecorder::on_rapid(const Rapid& event) {
  if (!is_reading()) return out().on_rapid(event);
  PatternMove move = move_of(PatternMove::Kind::Rapid, event.origin);
  move.to = point_of(event.to);
  record(move);
}

void PatternRecorder::on_line(const Line& event) {
  if (!is_reading()) return out().on_line(event);
  PatternMove move = move_of(PatternMove::Kind::Line, event.origin);
  move.to = point_of(event.to);
  set_feed(move, event.feed);
  record(move);
}

void PatternRecorder::on_arc(const Arc& event) {
  if (!is_reading()) return out().on_arc(event);
  PatternMove move = move_of(PatternMove::Kind::Arc, event.origin);
  move.to = point_of(event.to);
  move.center = {event.center_second.mm(), event.center_first.mm()};
  move.sweep = event.sweep.degrees();
  move.is_clockwise = event.turn == Turn::Clockwise;
  set_feed(move, event.feed);
  record(move);
}

void PatternRecorder::on_thread(const Thread& event) {
  if (!is_reading()) return out().on_thread(event);
  refuse(PatternFault::Thread);
}

void PatternRecorder::on_probe(const Probe& event) {
  if (!is_reading()) return out().on_probe(event);
  refuse(PatternFault::Probe);
}

void PatternRecorder::on_spindle(const Spindle& event) {
  if (!is_reading()) return out().on_spindle(event);
  PatternMove move = move_of(PatternMove::Kind::Spindle, event.origin);
  move.spindle = event.state;
  move.revolutions = event.revolutions_per_minute;
  if (event.surface_speed) move.surface = event.surface_speed->mm();
  if (event.max_revolutions) move.max_revolutions = *event.max_revolutions;
  record(move);
}

}  // namespace dripline::interpreter::centurion
