#include "gateway/interpreter/joining/joiner.hpp"

#include <cmath>
#include <type_traits>

#include "gateway/interpreter/joining/impl/joint.hpp"
#include "gateway/interpreter/joining/impl/path_writer.hpp"
#include "gateway/interpreter/joining/impl/state_bytes.hpp"

namespace dripline::interpreter::joining {

using namespace impl;

namespace {

void give(EventSink& sink, const Rapid& move) {
  sink.on_rapid(move);
}
void give(EventSink& sink, const Line& move) {
  sink.on_line(move);
}

/// Little is written: a move announces nothing as a rule.
void forget(Announced& announced) {
  announced.corner.reset();
  announced.estimate.reset();
  announced.back.reset();
}

CornerShape::Kind kind_of(Chamfer measure) {
  return measure == Chamfer::Leg ? CornerShape::Kind::ChamferLeg : CornerShape::Kind::ChamferFace;
}

}  // namespace

Joiner::Joiner(const Policy& policy, EventSink& sink, const Position& start)
    : policy_(policy), sink_(&sink) {
  reset(start);
}

Joiner::Joiner(const Policy& policy, compensation::Compensator& behind, const Position& start)
    : policy_(policy), sink_(&behind), compensator_(&behind) {
  reset(start);
}

void Joiner::reset(const Position& start) {
  state_.has_element = false;
  forget(state_.next);
  state_.has_end = false;
  state_.held.clear();
  fault_.reset();
  follow(start);
}

void Joiner::place(const Position& at) {
  settle();
  follow(at);
}

/// The machine is where the program thinks it is.
void Joiner::follow(const Position& to) {
  state_.programmed = to;
  state_.given = to;
}

void Joiner::set_plane(Plane plane) {
  if (plane == state_.plane) return;
  settle();
  state_.plane = plane;
}

void Joiner::lead_to(EventSink& sink) {
  sink_ = &sink;
  compensator_ = nullptr;
}
void Joiner::lead_to(compensation::Compensator& behind) {
  sink_ = &behind;
  compensator_ = &behind;
}

void Joiner::announce(CornerShape::Kind kind, Length size, std::optional<Feed> feed) {
  state_.next.corner.reset();
  if (size.mm() != 0) state_.next.corner = {kind, size.mm(), false, feed};
}

void Joiner::round_next_corner(Length radius, std::optional<Feed> feed) {
  announce(CornerShape::Kind::Round, radius, feed);
}

void Joiner::chamfer_next_corner(Length size, Chamfer measure, std::optional<Feed> feed) {
  announce(kind_of(measure), size, feed);
}

void Joiner::shape_waiting(CornerShape::Kind kind, const Origin& origin, Length size,
                           std::optional<Feed> feed) {
  if (fault_) return;
  if (!state_.has_element) return refuse(FaultKind::NoElement, origin, origin);
  if (size.mm() == 0) return;
  state_.waiting().announced.corner = {kind, size.mm(), true, feed};
  hold_or_pass(CornerPlace{origin});
}

void Joiner::round_corner(const Origin& origin, Length radius, std::optional<Feed> feed) {
  shape_waiting(CornerShape::Kind::Round, origin, radius, feed);
}

void Joiner::chamfer_corner(const Origin& origin, Length size, Chamfer measure,
                            std::optional<Feed> feed) {
  shape_waiting(kind_of(measure), origin, size, feed);
}

void Joiner::drop_corner() {
  if (state_.has_element) state_.waiting().announced.corner.reset();
}

void Joiner::estimate_next(Length tolerance, Length radius) {
  state_.next.estimate = {tolerance.mm(), radius.mm()};
}

void Joiner::lead_next_back(Angle slope, Back which) {
  const double radians = slope.radians();
  state_.next.back = {{std::cos(radians), std::sin(radians)}, which};
}

std::vector<std::byte> Joiner::state() const {
  return to_bytes(state_);
}

Result<void> Joiner::restore(const std::vector<std::byte>& state) {
  auto restored = from_bytes(state_, state);
  if (restored) fault_.reset();
  return restored;
}

void Joiner::refuse(FaultKind kind, const Origin& origin, const Origin& next) {
  fault_ = Fault{.kind = kind, .origin = origin, .next = next, .value = {}, .limit = {}};
}

template <class Move>
void Joiner::take_straight(const Move& move, Feed feed, bool rests) {
  if (fault_) return;
  constexpr bool kIsRapid = std::is_same_v<Move, Rapid>;
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector from = in_plane(state_.programmed, axes);
  const PlaneVector end = in_plane(move.to, axes);
  if (length(end - from) <= kNoLength && !state_.next.back) return take_aside(move);
  Element& element = state_.spare();
  element.is_arc = false;
  element.is_rapid = kIsRapid;
  element.line = {move.origin, move.to, feed, rests};
  element.from = from;
  element.end = end;
  element.sweep = 0;
  take(element);
}

/// A move of axes outside the plane. The programmed point in the plane stays, so that many moves
/// too short to count add up to one that does.
template <class Move>
void Joiner::take_aside(const Move& move) {
  forget(state_.next);
  if (!state_.has_element) {
    follow(move.to);
    return joining::give(*sink_, move);
  }
  const PlaneVector from = in_plane(state_.programmed, axes_of(state_.plane));
  state_.programmed = move.to;
  set_in_plane(state_.programmed, axes_of(state_.plane), from);
  hold_or_pass(move);
}

void Joiner::on_rapid(const Rapid& event) {
  if (policy_.joins_rapids) return take_straight(event, Feed{}, event.rests);
  settle();
  if (fault_) return;
  forget(state_.next);
  follow(event.to);
  sink_->on_rapid(event);
}

/// Two lines with nothing to say about the corner between them: no geometry, and little copying.
bool Joiner::flows_on(const Line& event) {
  if (!state_.has_element || state_.next.corner || state_.next.back || fault_) return false;
  Element& element = state_.waiting();
  if (element.is_arc || element.announced.corner) return false;
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector end = in_plane(event.to, axes);
  const PlaneVector way = end - in_plane(state_.programmed, axes);
  if (std::fabs(way.first) + std::fabs(way.second) <= 2 * kNoLength) return false;
  finish(nullptr);
  element.from = element.end;
  element.end = end;
  element.is_rapid = element.is_moved = false;
  element.line = event;
  element.announced.estimate = state_.next.estimate;
  element.announced.back.reset();
  state_.next.estimate.reset();
  state_.programmed = event.to;
  state_.has_element = true;
  if (!waits(element)) settle();
  return true;
}

void Joiner::on_line(const Line& event) {
  if (flows_on(event)) [[likely]]
    return;
  take_straight(event, event.feed, event.rests);
}

void Joiner::on_arc(const Arc& event) {
  if (fault_) return;
  if (event.plane != state_.plane) {
    if (state_.has_element && state_.waiting().announced.corner)
      return refuse(FaultKind::OtherPlane, state_.waiting().line.origin, event.origin);
    if (state_.next.corner) return refuse(FaultKind::OtherPlane, event.origin, event.origin);
    settle();
    forget(state_.next);
    follow(event.to);
    return sink_->on_arc(event);
  }
  const PlaneAxes axes = axes_of(state_.plane);
  Element& element = state_.spare();
  element.is_arc = true;
  element.is_rapid = false;
  element.line = {event.origin, event.to, event.feed, event.rests};
  element.from = in_plane(state_.programmed, axes);
  element.end = in_plane(event.to, axes);
  element.center = {event.center_first.mm(), event.center_second.mm()};
  element.side = event.turn == Turn::CounterClockwise ? 1 : -1;
  element.sweep = event.sweep.radians();
  element.given_sweep = event.sweep;
  take(element);
}

bool Joiner::waits(const Element& element) const {
  return (policy_.every_move_waits && (!element.is_rapid || policy_.joins_rapids)) ||
         element.announced.corner || element.announced.estimate;
}

/// A move in the plane, as programmed.
void Joiner::take(Element& element) {
  element.is_moved = false;
  element.announced = state_.next;
  forget(state_.next);
  if (state_.has_element) {
    join(element);
  } else {
    begin_alone(element);
  }
  if (fault_) return;
  state_.programmed = element.line.to;
  state_.swap_elements();
  state_.has_element = true;
  if (!waits(element)) settle();
}

/// Nothing waits: the machine stands where this element begins.
void Joiner::begin_alone(const Element& element) {
  if (element.announced.back)
    return refuse(FaultKind::NoElement, element.line.origin, element.line.origin);
  const Joint joint = joint_on(element, element.from);
  if (!joint.fault) return;
  refuse(*joint.fault, element.line.origin, element.line.origin);
  fault_->value = Length::mm(joint.off_by);
  fault_->limit = Length::mm(joint.radius);
}

void Joiner::join(Element& next) {
  Element& first = state_.waiting();
  const Joint joint = joint_of(first, next);
  if (joint.fault) {
    refuse(*joint.fault, first.line.origin, next.line.origin);
    fault_->value = Length::mm(joint.off_by);
    fault_->limit = Length::mm(joint.radius);
    return;
  }
  next.from = first.end;
  first.end_at(joint.at);
  next.begin_at(joint.at);
  if (!first.announced.corner) return finish(nullptr);
  const Corner corner = shape_corner(*first.announced.corner, policy_, first, next);
  if (!corner.fault) return finish(corner.is_piece ? &corner : nullptr);
  refuse(*corner.fault, first.line.origin, next.line.origin);
  fault_->value = Length::mm(corner.value);
  fault_->limit = Length::mm(corner.limit);
  fault_->first_is_arc = first.is_arc;
  fault_->next_is_arc = next.is_arc;
}

void Joiner::lead_back(const Thread& thread) {
  if (!state_.has_element) return refuse(FaultKind::NoElement, thread.origin, thread.origin);
  const PlaneAxes axes = axes_of(state_.plane);
  Element& element = state_.spare();
  element.is_arc = element.is_rapid = false;
  element.line = {thread.origin, thread.to, {}, false};
  element.from = in_plane(state_.programmed, axes);
  element.end = in_plane(thread.to, axes);
  element.sweep = 0;
  element.announced = state_.next;
  join(element);
}

/// The end of the element that waits is decided.
void Joiner::finish(const Corner* corner) {
  PathWriter writer(*sink_, state_);
  const Element& element = state_.waiting();
  writer.put_out(element);
  if (corner && !element.announced.corner->has_own_block)
    writer.put_out(*corner, element, element.line.origin);
  state_.has_element = false;
  release_held(corner);
}

void Joiner::settle() {
  if (!state_.has_element || fault_) return;
  const Element& element = state_.waiting();
  if (element.announced.corner && policy_.refuses_open_corner)
    return refuse(FaultKind::OpenCorner, element.line.origin, element.line.origin);
  const Joint joint = joint_on(element, element.end);
  if (!joint.fault) return finish(nullptr);
  refuse(*joint.fault, element.line.origin, element.line.origin);
  fault_->value = Length::mm(joint.off_by);
  fault_->limit = Length::mm(joint.radius);
}

}  // namespace dripline::interpreter::joining
