#include "gateway/interpreter/stages/blending/corner_blender.hpp"

#include <cmath>
#include <type_traits>

#include "gateway/interpreter/stages/blending/impl/blend.hpp"
#include "gateway/interpreter/stages/blending/impl/path_writer.hpp"
#include "gateway/interpreter/stages/blending/impl/state_bytes.hpp"

namespace dripline::interpreter::blending {

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

CornerBlender::CornerBlender(const Policy& policy, EventSink& sink, const Position& start)
    : policy_(policy), sink_(&sink) {
  reset(start);
}

CornerBlender::CornerBlender(const Policy& policy, compensation::Compensator& after,
                             const Position& start)
    : policy_(policy), sink_(&after), compensator_(&after) {
  reset(start);
}

void CornerBlender::reset(const Position& start) {
  state_.has_element = false;
  forget(state_.next);
  state_.has_end = false;
  state_.held.clear();
  fault_.reset();
  follow(start);
}

void CornerBlender::place(const Position& at) {
  settle();
  follow(at);
}

/// The machine is where the program thinks it is.
void CornerBlender::follow(const Position& to) {
  state_.programmed = to;
  state_.given = to;
}

void CornerBlender::set_plane(Plane plane) {
  if (plane == state_.plane) return;
  settle();
  state_.plane = plane;
}

void CornerBlender::lead_to(EventSink& sink) {
  sink_ = &sink;
  compensator_ = nullptr;
}
void CornerBlender::lead_to(compensation::Compensator& after) {
  sink_ = &after;
  compensator_ = &after;
}

void CornerBlender::announce(CornerShape::Kind kind, Length size, std::optional<Feed> feed) {
  state_.next.corner.reset();
  if (size.mm() != 0) state_.next.corner = {kind, size.mm(), false, feed};
}

void CornerBlender::round_next_corner(Length radius, std::optional<Feed> feed) {
  announce(CornerShape::Kind::Round, radius, feed);
}

void CornerBlender::chamfer_next_corner(Length size, Chamfer measure, std::optional<Feed> feed) {
  announce(kind_of(measure), size, feed);
}

void CornerBlender::shape_waiting(CornerShape::Kind kind, const Origin& origin, Length size,
                                  std::optional<Feed> feed) {
  if (fault_) return;
  if (!state_.has_element) return refuse(FaultKind::NoElement, origin, origin);
  if (size.mm() == 0) return;
  state_.waiting().announced.corner = {kind, size.mm(), true, feed};
  hold_or_pass(CornerPlace{origin});
}

void CornerBlender::round_corner(const Origin& origin, Length radius, std::optional<Feed> feed) {
  shape_waiting(CornerShape::Kind::Round, origin, radius, feed);
}

void CornerBlender::chamfer_corner(const Origin& origin, Length size, Chamfer measure,
                                   std::optional<Feed> feed) {
  shape_waiting(kind_of(measure), origin, size, feed);
}

void CornerBlender::drop_corner() {
  if (state_.has_element) state_.waiting().announced.corner.reset();
}

void CornerBlender::approximate_end(Length tolerance, Length radius) {
  state_.next.estimate = {tolerance.mm(), radius.mm()};
}

void CornerBlender::back_solve_line(Angle slope, Back which) {
  const double radians = slope.radians();
  state_.next.back = {{std::cos(radians), std::sin(radians)}, which};
}

std::vector<std::byte> CornerBlender::state() const {
  return to_bytes(state_);
}

Result<void> CornerBlender::restore(const std::vector<std::byte>& state) {
  auto restored = from_bytes(state_, state);
  if (restored) fault_.reset();
  return restored;
}

void CornerBlender::refuse(FaultKind kind, const Origin& origin, const Origin& next) {
  fault_ = Fault{.kind = kind, .origin = origin, .next = next, .value = {}, .limit = {}};
}

template <class Move>
void CornerBlender::on_linear(const Move& move, Feed feed, bool rests) {
  if (fault_) return;
  constexpr bool kIsRapid = std::is_same_v<Move, Rapid>;
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector from = in_plane(state_.programmed, axes);
  const PlaneVector end = in_plane(move.to, axes);
  if (length(end - from) <= kNoLength && !state_.next.back) return off_plane_move(move);
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
void CornerBlender::off_plane_move(const Move& move) {
  forget(state_.next);
  if (!state_.has_element) {
    follow(move.to);
    return blending::give(*sink_, move);
  }
  const PlaneVector from = in_plane(state_.programmed, axes_of(state_.plane));
  state_.programmed = move.to;
  set_in_plane(state_.programmed, axes_of(state_.plane), from);
  hold_or_pass(move);
}

void CornerBlender::on_rapid(const Rapid& event) {
  if (policy_.blends_rapids) return on_linear(event, Feed{}, event.rests);
  settle();
  if (fault_) return;
  forget(state_.next);
  follow(event.to);
  sink_->on_rapid(event);
}

/// Two lines with nothing to say about the corner between them: no geometry, and little copying.
bool CornerBlender::flows_on(const Line& event) {
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

void CornerBlender::on_line(const Line& event) {
  if (flows_on(event)) [[likely]]
    return;
  on_linear(event, event.feed, event.rests);
}

void CornerBlender::on_arc(const Arc& event) {
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
  element.side = event.turn == Turn::Counterclockwise ? 1 : -1;
  element.sweep = event.sweep.radians();
  element.given_sweep = event.sweep;
  take(element);
}

bool CornerBlender::waits(const Element& element) const {
  return (policy_.every_move_waits && (!element.is_rapid || policy_.blends_rapids)) ||
         element.announced.corner || element.announced.estimate;
}

/// A move in the plane, as programmed.
void CornerBlender::take(Element& element) {
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
void CornerBlender::begin_alone(const Element& element) {
  if (element.announced.back)
    return refuse(FaultKind::NoElement, element.line.origin, element.line.origin);
  const Blend blend = blend_on(element, element.from);
  if (!blend.fault) return;
  refuse(*blend.fault, element.line.origin, element.line.origin);
  fault_->value = Length::mm(blend.off_by);
  fault_->limit = Length::mm(blend.radius);
}

void CornerBlender::join(Element& next) {
  Element& first = state_.waiting();
  const Blend blend = blend_of(first, next);
  if (blend.fault) {
    refuse(*blend.fault, first.line.origin, next.line.origin);
    fault_->value = Length::mm(blend.off_by);
    fault_->limit = Length::mm(blend.radius);
    return;
  }
  next.from = first.end;
  first.end_at(blend.at);
  next.begin_at(blend.at);
  if (!first.announced.corner) return finish(nullptr);
  const Corner corner = shape_corner(*first.announced.corner, policy_, first, next);
  if (!corner.fault) return finish(corner.is_piece ? &corner : nullptr);
  refuse(*corner.fault, first.line.origin, next.line.origin);
  fault_->value = Length::mm(corner.value);
  fault_->limit = Length::mm(corner.limit);
  fault_->first_is_arc = first.is_arc;
  fault_->next_is_arc = next.is_arc;
}

void CornerBlender::lead_back(const Thread& thread) {
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
void CornerBlender::finish(const Corner* corner) {
  PathWriter writer(*sink_, state_);
  const Element& element = state_.waiting();
  writer.put_out(element);
  if (corner && !element.announced.corner->has_own_block)
    writer.put_out(*corner, element, element.line.origin);
  state_.has_element = false;
  release_held(corner);
}

void CornerBlender::settle() {
  if (!state_.has_element || fault_) return;
  const Element& element = state_.waiting();
  if (element.announced.corner && policy_.refuses_open_corner)
    return refuse(FaultKind::OpenCorner, element.line.origin, element.line.origin);
  const Blend blend = blend_on(element, element.end);
  if (!blend.fault) return finish(nullptr);
  refuse(*blend.fault, element.line.origin, element.line.origin);
  fault_->value = Length::mm(blend.off_by);
  fault_->limit = Length::mm(blend.radius);
}

}  // namespace dripline::interpreter::blending
