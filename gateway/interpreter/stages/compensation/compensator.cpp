#include "gateway/interpreter/stages/compensation/compensator.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "gateway/interpreter/stages/compensation/impl/corner.hpp"
#include "gateway/interpreter/stages/compensation/impl/path_writer.hpp"

namespace dripline::interpreter::compensation {

using namespace impl;

namespace {

/// Rounding may make an arc this much smaller than the cutter.
constexpr double kFits = 1e-9;

void give(EventSink& sink, const Rapid& move) {
  sink.on_rapid(move);
}
void give(EventSink& sink, const Line& move) {
  sink.on_line(move);
}

}  // namespace

Compensator::Compensator(const Policy& policy, EventSink& sink, const Position& start)
    : LookAheadStage(sink), policy_(policy) {
  reset(start);
}

void Compensator::reset(const Position& start) {
  state_.phase = Phase::Off;
  state_.has_element = false;
  state_.is_output_suppressed = false;
  state_.offset = 0;
  state_.tip = {};
  state_.start_up = StartUp::NextNormal;
  state_.next_corner.reset();
  state_.next_arc.reset();
  state_.begins_contour = false;
  state_.held.clear();
  state_.idle_blocks = 0;
  fault_.reset();
  follow(start);
}

/// The machine is where the program thinks it is.
void Compensator::follow(const Position& to) {
  state_.programmed = to;
  state_.sent = to;
  state_.is_displaced = false;
}

/// The program continues, the tool stays.
void Compensator::pass_over(const Position& to) {
  state_.programmed = to;
  state_.is_displaced = true;
}

/// Off, with the tool on another point of the plane than the program.
bool Compensator::is_off_plane() const {
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector apart = in_plane(state_.sent, axes) - in_plane(state_.programmed, axes);
  return state_.is_displaced && length(apart) > kNoLength;
}

/// The place of the nose center; the tool's position is that of its tip.
PlaneVector Compensator::nose() const {
  return in_plane(state_.sent, axes_of(state_.plane)) - state_.tip;
}

template <class Move>
void Compensator::on_linear(const Move& move, Feed feed, bool rests) {
  if (fault_) return;
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector from = in_plane(state_.programmed, axes);
  const PlaneVector end = in_plane(move.to, axes);
  const bool is_in_plane = dot(end - from, end - from) > kNoLength * kNoLength;
  if (state_.phase == Phase::Off && (is_in_plane || !state_.is_displaced)) {
    if (state_.is_output_suppressed) return pass_over(move.to);
    follow(move.to);
    return give(*sink_, move);
  }
  if (!is_in_plane) return hold_off_plane(move);
  Element& element = state_.spare();
  element.is_arc = element.rounds_corner = false;
  element.rests = rests;
  element.is_rapid = std::is_same_v<Move, Rapid>;
  element.origin = move.origin;
  element.to = move.to;
  element.feed = feed;
  element.from = from;
  element.end = end;
  complete_line(element);
  take(element);
}

void Compensator::flush() {
  if (!state_.has_element || fault_) return;
  finish(state_.waiting().own_end());
}

bool Compensator::make_room(const Origin& origin) {
  return refuse({FaultKind::TooMuchBetween, state_.waiting().origin, origin});
}

void Compensator::keep_in_plane(Position& to) const {
  const PlaneAxes axes = axes_of(state_.plane);
  set_in_plane(to, axes, in_plane(state_.sent, axes));
}

void Compensator::on_block_end(const Origin& event) {
  hold_or_deliver(look_ahead::BlockEnd{event}, event);
  if (!state_.has_element || event.block == state_.waiting().origin.block) return;
  if (++state_.idle_blocks > policy_.blocks_without_motion) flush();
}

void Compensator::on_uncounted_block_end(const Origin& event) {
  hold_or_deliver(look_ahead::BlockEnd{event}, event);
}

void Compensator::on_rapid(const Rapid& event) {
  on_linear(event, Feed{}, event.rests);
}

void Compensator::on_line(const Line& event) {
  on_linear(event, event.feed, event.rests);
}

void Compensator::on_arc(const Arc& event) {
  if (fault_) return;
  if (state_.phase == Phase::Off) {
    if (state_.is_output_suppressed) return pass_over(event.to);
    if (is_off_plane()) {
      refuse({FaultKind::CancelNotStraight, event.origin, event.origin});
      return;
    }
    follow(event.to);
    return sink_->on_arc(event);
  }
  if (event.plane != state_.plane) {
    refuse({FaultKind::OtherPlane, event.origin, event.origin});
    return;
  }
  Element& element = state_.spare();
  element.is_rapid = element.rounds_corner = false;
  element.rests = event.rests;
  element.origin = event.origin;
  element.to = event.to;
  element.feed = event.feed;
  const PlaneAxes axes = axes_of(state_.plane);
  element.from = in_plane(state_.programmed, axes);
  element.end = in_plane(event.to, axes);
  complete_arc(element, event);
  take(element);
}

Role Compensator::next_role() const {
  switch (state_.phase) {
    case Phase::Starting:
      return Role::StartUp;
    case Phase::Ending:
      return Role::Cancel;
    case Phase::Parallel:
      return Role::Parallel;
    case Phase::On:
    case Phase::Off:
      break;
  }
  return Role::Contour;
}

/// A move in the plane, with its programmed geometry complete.
void Compensator::take(Element& element) {
  element.offset = state_.offset;
  element.is_silent = state_.is_output_suppressed;
  element.outside = state_.next_corner.value_or(policy_.outside);
  state_.next_corner.reset();
  element.role = next_role();
  element.start_up = state_.start_up;
  element.by_arc = element.role == Role::Cancel ? state_.next_arc : std::nullopt;
  state_.next_arc.reset();
  element.lead_in.count = 0;
  if (element.is_arc && !accepts_arc(element)) return;
  if (state_.has_element) {
    decide_corner(element);
  } else {
    begin_alone(element);
  }
  if (fault_) return;
  state_.programmed = element.to;
  if (element.role == Role::Cancel || element.role == Role::Parallel)
    return end_compensation(element);
  state_.swap_elements();
  state_.has_element = true;
  state_.idle_blocks = 0;
  state_.is_displaced = true;
  state_.phase = Phase::On;
}

bool Compensator::accepts_arc(const Element& arc) {
  const Origin& origin = arc.origin;
  if (arc.role == Role::StartUp) return refuse({FaultKind::StartUpNotStraight, origin, origin});
  if (arc.role != Role::Contour) return refuse({FaultKind::CancelNotStraight, origin, origin});
  const double radius = std::min(arc.arch.radius_in, arc.arch.radius_out);
  if (std::min(arc.offset_radius_in(), arc.offset_radius_out()) < -kFits)
    return refuse({FaultKind::ArcTooSmall, origin, origin, Length::mm(radius),
                   Length::mm(std::fabs(arc.offset)), state_.has_element && state_.waiting().is_arc,
                   true});
  return true;
}

/// The corner between the waiting element and `next` is known now.
void Compensator::decide_corner(Element& next) {
  const Element& first = state_.waiting();
  if (first.rounds_corner && !end_corner(next)) return;
  const CornerEnd corner = round_corner(policy_, first, next, nose());
  if (corner.fault) {
    refuse({*corner.fault, first.origin, next.origin, Length::mm(length(first.end - nose())),
            Length::mm(std::fabs(first.offset)), first.is_arc, next.is_arc});
    return;
  }
  const bool was_silent = first.is_silent;
  finish(corner.end);
  if (was_silent) reach_begin(next);
}

/// The tool was not led there: a line goes straight to its end, an arc has to begin on its circle.
void Compensator::reach_begin(Element& next) {
  next.lead_in.count = 0;
  if (next.is_arc && length(next.begin - nose()) > kNoLength)
    next.lead_in.add({.is_arc = false, .to = next.begin, .center = {}});
}

/// No element waits: the tool is on an end that was decided without this one.
void Compensator::begin_alone(Element& element) {
  element.begin = nose();
  if (element.role != Role::Contour) return;
  if (!element.is_arc && policy_.resume == Resume::Straight) return;
  element.begin = element.own_begin();
  if (length(element.begin - nose()) > kNoLength)
    element.lead_in.add({.is_arc = false, .to = element.begin, .center = {}});
}

void Compensator::finish(PlaneVector end) {
  PathWriter writer(*sink_, state_, policy_.arc_at_rapid);
  const Element& element = state_.waiting();
  if (!element.is_silent && !writer.put_out(element, end)) {
    refuse({FaultKind::Reversed, element.origin, element.origin});
    return;
  }
  state_.has_element = false;
  deliver_held();
}

/// A move that ends compensation: where it ends is known.
void Compensator::end_compensation(const Element& element) {
  if (element.is_silent) {
    state_.is_displaced = true;
    state_.phase = Phase::Off;
    return;
  }
  PlaneVector tip = element.end;
  if (element.role == Role::Parallel)
    tip = tip + in_plane(state_.sent, axes_of(state_.plane)) - element.from;
  PathWriter(*sink_, state_, policy_.arc_at_rapid).put_out_straight(element, tip);
  state_.is_displaced = element.role == Role::Parallel;
  state_.phase = state_.begins_contour ? Phase::On : Phase::Off;
  state_.begins_contour = false;
}

}  // namespace dripline::interpreter::compensation
