#include <cmath>

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// The commands that turn compensation on and off.

namespace dripline::interpreter::compensation {

// A corner that a block of its own rounds.

using namespace impl;

/// The direction of the last compensated move at its end.
std::optional<PlaneVector> Compensator::last_direction() const {
  if (state_.has_element) return state_.waiting().direction_out;
  if (state_.phase != Phase::On) return std::nullopt;
  // ended on its own normal
  const PlaneVector out = nose() - in_plane(state_.programmed, axes_of(state_.plane));
  if (std::fabs(length(out) - std::fabs(state_.offset)) > kNoLength) return std::nullopt;
  return (-1 / state_.offset) * left_of(out);
}

bool Compensator::round_outside_corner(const Origin& origin, Feed feed,
                                       std::optional<PlaneVector> along) {
  if (fault_ || state_.offset == 0) return true;
  const auto direction = last_direction();
  if (!direction || state_.phase != Phase::On) return false;
  Element& element = state_.spare();
  element.is_rapid = element.rests = false;
  element.origin = origin;
  element.to = state_.programmed;
  element.feed = feed;
  element.offset = state_.offset;
  complete_corner(element, in_plane(state_.programmed, axes_of(state_.plane)), *direction);
  if (along && !turn_corner(element, *along)) {
    refuse({FaultKind::ConcaveCorner, origin, origin});
    return true;
  }
  take(element);
  if (along) flush();
  return true;
}

/// The waiting element rounds a corner, and the next element is known now.
bool Compensator::end_corner(const Element& next) {
  if (turn_corner(state_.waiting(), next.direction_in)) return true;
  return refuse({FaultKind::ConcaveCorner, state_.waiting().origin, next.origin});
}

bool Compensator::is_on() const {
  return state_.phase == Phase::Starting || state_.phase == Phase::On;
}

bool Compensator::changes_tip(const Cutter& cutter) const {
  const PlaneVector tip{cutter.tip_first.mm(), cutter.tip_second.mm()};
  return (state_.has_element || state_.phase == Phase::On) && tip != state_.tip;
}

void Compensator::lead_to(EventSink& sink) {
  sink_ = &sink;
}

void Compensator::on_compensation(const Command& command) {
  switch (command.kind) {
    case Command::Kind::TurnOn:
      return start(command.cutter, command.start_up.value_or(policy_.start_up));
    case Command::Kind::TurnOff:
      return stop();
    case Command::Kind::Cancel:
      flush();
      state_.phase = Phase::Off;
      return;
    case Command::Kind::SuppressOutput:
    case Command::Kind::ResumeOutput:
      state_.is_output_suppressed = command.kind == Command::Kind::SuppressOutput;
      return;
  }
}

void Compensator::start(const Cutter& cutter, StartUp start_up) {
  if (cutter.plane != state_.plane) cancel();
  // a waiting contour continues, even after a cancel without a move
  if (state_.has_element) state_.phase = Phase::On;
  if (state_.phase != Phase::On) state_.phase = Phase::Starting;
  state_.start_up = start_up;
  use(cutter);
}

void Compensator::use(const Cutter& cutter) {
  state_.begins_contour = false;
  state_.plane = cutter.plane;
  state_.offset = (cutter.side == Side::Left ? 1 : -1) * cutter.radius.mm();
  state_.tip = {cutter.tip_first.mm(), cutter.tip_second.mm()};
}

void Compensator::stop() {
  if (state_.phase == Phase::On) {
    state_.phase = Phase::Ending;
    if (policy_.cancel == Cancel::OwnNormal) flush();
  } else if (state_.phase == Phase::Starting) {
    state_.phase = Phase::Off;
  }
}

bool Compensator::approach_by_arc(const Origin& origin, Length radius) {
  if (!state_.has_element || state_.waiting().role != Role::StartUp) return false;
  state_.waiting().by_arc = ByArc{radius.mm(), origin};
  return true;
}

void Compensator::turn_off_by_arc(const Origin& origin, Length radius) {
  if (state_.phase != Phase::On) return stop();
  state_.phase = Phase::Ending;
  state_.next_arc = ByArc{radius.mm(), origin};
}

void Compensator::begin_contour(const Cutter& cutter) {
  flush();
  use(cutter);
  state_.phase = Phase::On;
  state_.is_displaced = true;
}

void Compensator::begin_contour(const Cutter& cutter, PlaneVector programmed) {
  begin_contour(cutter);
  set_in_plane(state_.programmed, axes_of(state_.plane), programmed);
}

void Compensator::turn_on_in_parallel(const Cutter& cutter) {
  cancel_in_parallel();
  use(cutter);
  state_.begins_contour = true;
}

void Compensator::start_again() {
  if (!state_.has_element || state_.waiting().role != Role::StartUp || fault_) return;
  finish(state_.waiting().end);
  state_.phase = Phase::Starting;
}

void Compensator::shape_corner(OutsideCorner shape) {
  if (state_.has_element) state_.waiting().outside = shape;
}

void Compensator::cancel(PlaneVector programmed) {
  cancel();
  const PlaneAxes axes = axes_of(state_.plane);
  set_in_plane(state_.programmed, axes, programmed);
  state_.is_displaced = in_plane(state_.sent, axes) != programmed;
}

void Compensator::cancel_in_parallel() {
  flush();
  state_.phase = Phase::Parallel;
  state_.begins_contour = false;
}

void Compensator::shape_next_corner(OutsideCorner shape) {
  state_.next_corner = shape;
}

}  // namespace dripline::interpreter::compensation
