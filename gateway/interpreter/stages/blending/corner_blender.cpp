#include "gateway/interpreter/stages/blending/corner_blender.hpp"

#include <cmath>
#include <type_traits>

#include "gateway/interpreter/stages/blending/impl/corner.hpp"
#include "gateway/interpreter/stages/blending/impl/path_writer.hpp"

namespace dripline::interpreter::blending {

using namespace impl;

namespace {

void give(EventSink& sink, const Rapid& move) {
  sink.on_rapid(move);
}
void give(EventSink& sink, const Line& move) {
  sink.on_line(move);
}

/// Few members are written, because most moves announce nothing.
void drop(Announced& announced) {
  announced.corner.reset();
  announced.estimate.reset();
  announced.back.reset();
}

CornerShape::Kind kind_of(Chamfer measure) {
  return measure == Chamfer::Leg ? CornerShape::Kind::ChamferLeg : CornerShape::Kind::ChamferFace;
}

}  // namespace

CornerBlender::CornerBlender(const Policy& policy, EventSink& sink, const Position& start)
    : LookAheadStage(sink), policy_(policy) {
  reset(start);
}

CornerBlender::CornerBlender(const Policy& policy, CompensationSink& sink, const Position& start)
    : LookAheadStage(sink), policy_(policy), compensation_(&sink) {
  reset(start);
}

void CornerBlender::reset(const Position& start) {
  state_.has_element = false;
  drop(state_.next);
  state_.has_end = false;
  state_.held.clear();
  fault_.reset();
  follow(start);
}

/// The machine is where the program thinks it is.
void CornerBlender::follow(const Position& to) {
  state_.programmed = to;
  state_.sent = to;
}

void CornerBlender::set_plane(Plane plane) {
  if (plane == state_.plane) return;
  flush();
  state_.plane = plane;
}

void CornerBlender::lead_to(EventSink& sink) {
  sink_ = &sink;
  compensation_ = nullptr;
}
void CornerBlender::lead_to(CompensationSink& sink) {
  sink_ = compensation_ = &sink;
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
  if (!state_.has_element) {
    refuse({FaultKind::NoElement, origin, origin});
    return;
  }
  if (size.mm() == 0) return;
  state_.waiting().announced.corner = {kind, size.mm(), true, feed};
  hold_or_deliver(CornerPlace{origin});
}

void CornerBlender::round_corner(const Origin& origin, Length radius, std::optional<Feed> feed) {
  shape_waiting(CornerShape::Kind::Round, origin, radius, feed);
}

void CornerBlender::chamfer_corner(const Origin& origin, Length size, Chamfer measure,
                                   std::optional<Feed> feed) {
  shape_waiting(kind_of(measure), origin, size, feed);
}

const Origin* CornerBlender::open_corner() const {
  const bool is_open = state_.has_element && state_.waiting().announced.corner;
  return is_open ? &state_.waiting().line.origin : nullptr;
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

template <class Move>
void CornerBlender::on_linear(const Move& move, Feed feed, bool rests) {
  if (fault_) return;
  constexpr bool kIsRapid = std::is_same_v<Move, Rapid>;
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector from = in_plane(state_.programmed, axes);
  const PlaneVector end = in_plane(move.to, axes);
  if (length(end - from) <= kNoLength && !state_.next.back) {
    drop(state_.next);
    if (state_.has_element) return hold_off_plane(move);
    follow(move.to);
    return give(*sink_, move);
  }
  Element& element = state_.spare();
  element.make_line();
  element.is_rapid = kIsRapid;
  element.line = {move.origin, move.to, feed, rests};
  element.from = from;
  element.end = end;
  take(element);
}

void CornerBlender::on_rapid(const Rapid& event) {
  if (policy_.blends_rapids) return on_linear(event, Feed{}, event.rests);
  flush();
  if (fault_) return;
  drop(state_.next);
  follow(event.to);
  sink_->on_rapid(event);
}

/// Two lines whose corner no word shapes: no geometry, and little copying.
bool CornerBlender::flows_on(const Line& event) {
  if (!state_.has_element || state_.next.corner || state_.next.back || fault_) return false;
  Element& element = state_.waiting();
  if (element.is_arc || element.announced.corner) return false;
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector end = in_plane(event.to, axes);
  const PlaneVector along = end - in_plane(state_.programmed, axes);
  if (std::fabs(along.first) + std::fabs(along.second) <= 2 * kNoLength) return false;
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
  if (!waits(element)) flush();
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
    const bool shapes_corner = state_.has_element && state_.waiting().announced.corner;
    if (shapes_corner || state_.next.corner) {
      refuse({FaultKind::OtherPlane, shapes_corner ? state_.waiting().line.origin : event.origin,
              event.origin});
      return;
    }
    flush();
    drop(state_.next);
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
  drop(state_.next);
  if (state_.has_element) {
    decide_corner(element);
  } else {
    begin_alone(element);
  }
  if (fault_) return;
  state_.programmed = element.line.to;
  state_.swap_elements();
  state_.has_element = true;
  if (!waits(element)) flush();
}

/// Whether an arc that no blend corrects has its `end` on its circle; else refused.
bool CornerBlender::ends_on_arc(const Element& element, PlaneVector end) {
  const Blend blend = blend_on(element, end);
  if (!blend.fault) return true;
  const Origin& origin = element.line.origin;
  return refuse({*blend.fault, origin, origin, Length::mm(blend.off_by), Length::mm(blend.radius)});
}

/// Nothing waits: the machine is where this element begins.
void CornerBlender::begin_alone(const Element& element) {
  if (element.announced.back) {
    refuse({FaultKind::NoElement, element.line.origin, element.line.origin});
  } else {
    ends_on_arc(element, element.from);
  }
}

/// The waiting element meets its successor.
void CornerBlender::decide_corner(Element& next) {
  Element& first = state_.waiting();
  const Blend blend = blend_of(first, next);
  if (blend.fault) {
    refuse({*blend.fault, first.line.origin, next.line.origin, Length::mm(blend.off_by),
            Length::mm(blend.radius)});
    return;
  }
  next.from = first.end;
  first.end_at(blend.at);
  next.begin_at(blend.at);
  if (!first.announced.corner) return finish(nullptr);
  const Corner corner = shape_corner(*first.announced.corner, policy_, first, next);
  if (!corner.fault) return finish(corner.is_piece ? &corner : nullptr);
  refuse({*corner.fault, first.line.origin, next.line.origin, Length::mm(corner.value),
          Length::mm(corner.limit), first.is_arc, next.is_arc});
}

void CornerBlender::lead_back(const Thread& thread) {
  if (!state_.has_element) {
    refuse({FaultKind::NoElement, thread.origin, thread.origin});
    return;
  }
  const PlaneAxes axes = axes_of(state_.plane);
  Element& element = state_.spare();
  element.make_line();
  element.is_rapid = false;
  element.line = {thread.origin, thread.to, {}, false};
  element.from = in_plane(state_.programmed, axes);
  element.end = in_plane(thread.to, axes);
  element.announced = state_.next;
  decide_corner(element);
}

/// The end of the waiting element is decided.
void CornerBlender::finish(const Corner* corner) {
  PathWriter writer(*sink_, state_);
  const Element& element = state_.waiting();
  writer.put_out(element);
  if (corner && !element.announced.corner->has_own_block)
    writer.put_out(*corner, element, element.line.origin);
  state_.has_element = false;
  if (state_.has_end) {
    state_.has_end = false;
    sink_->on_block_end(state_.end);
  }
  if (state_.held.empty()) [[likely]]
    return;
  corner_ = corner;
  deliver_held();
  corner_ = nullptr;
}

void CornerBlender::flush() {
  if (!state_.has_element || fault_) return;
  const Element& element = state_.waiting();
  if (element.announced.corner && policy_.refuses_open_corner) {
    refuse({FaultKind::OpenCorner, element.line.origin, element.line.origin});
    return;
  }
  if (ends_on_arc(element, element.end)) finish(nullptr);
}

/// A corner needs all events that are held at it; a plain move is put out instead.
bool CornerBlender::make_room(const Origin& origin) {
  if (state_.waiting().announced.corner)
    return refuse({FaultKind::TooMuchBetween, state_.waiting().line.origin, origin});
  flush();
  return !fault_;
}

void CornerBlender::keep_in_plane(Position& to) const {
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector at = in_plane(state_.sent, axes);
  if (in_plane(to, axes) != at) set_in_plane(to, axes, at);
}

void CornerBlender::on_compensation(const compensation::Command& command) {
  hold_or_deliver(command, Origin{});
}
void CornerBlender::deliver_own(const compensation::Command& command) {
  if (compensation_) compensation_->on_compensation(command);
}

void CornerBlender::on_block_end(const Origin& event) {
  if (state_.has_element && !state_.has_end && state_.held.empty() && !fault_) [[likely]] {
    state_.has_end = true;
    state_.end = event;
    return;
  }
  hold_or_deliver(look_ahead::BlockEnd{event}, event);
}

void CornerBlender::on_uncounted_block_end(const Origin& event) {
  hold_or_deliver(UncountedEnd{event}, event);
}
void CornerBlender::deliver_own(const UncountedEnd& end) {
  if (compensation_) return compensation_->on_uncounted_block_end(end.origin);
  sink_->on_block_end(end.origin);
}

void CornerBlender::deliver_own(const CornerPlace& place) {
  if (corner_) PathWriter(*sink_, state_).put_out(*corner_, state_.waiting(), place.origin);
}

/// A thread is no element that waits, but as a line it may be solved back to one.
void CornerBlender::on_thread(const Thread& event) {
  if (state_.next.back && !fault_) {
    lead_back(event);
  } else {
    flush();
  }
  if (fault_) return;
  state_.next = {};
  follow(event.to);
  sink_->on_thread(event);
}

}  // namespace dripline::interpreter::blending
