#include <type_traits>

#include "gateway/interpreter/stages/blending/corner_blender.hpp"
#include "gateway/interpreter/stages/blending/impl/path_writer.hpp"

/// The events that only pass through: at once, or after the move that waits.
namespace dripline::interpreter::blending {

using namespace impl;
using look_ahead::BlockEnd;
using look_ahead::Forwarder;
using look_ahead::held;
using look_ahead::HeldText;

/// A corner needs all that stands at it; a plain move goes out instead.
bool CornerBlender::make_room(const Origin& origin) {
  if (state_.waiting().announced.corner) {
    refuse(FaultKind::TooMuchBetween, state_.waiting().line.origin, origin);
    return false;
  }
  settle();
  return !fault_;
}

template <class Event>
void CornerBlender::hold_or_pass(const Event& event, const Origin& origin) {
  if (fault_) return;
  if (state_.has_element && state_.held.push(event)) return;
  if (state_.has_element && !make_room(origin)) return;
  give(event);
}
template void CornerBlender::hold_or_pass(const Rapid& event, const Origin& origin);
template void CornerBlender::hold_or_pass(const Line& event, const Origin& origin);
template void CornerBlender::hold_or_pass(const CornerPlace& event, const Origin& origin);

void CornerBlender::hold_or_pass(HeldText text, std::string_view content) {
  if (fault_) return;
  if (state_.has_element && state_.held.push(text, content)) return;
  if (state_.has_element && !make_room(text.origin)) return;
  Forwarder{*sink_}.give(text, content);
}

namespace {

void carry_out(compensation::Compensator& compensator, const CompensationCall& call) {
  switch (call.kind) {
    case CompensationCall::Kind::TurnOn:
      return compensator.turn_on(call.cutter);
    case CompensationCall::Kind::TurnOnAs:
      return compensator.turn_on(call.cutter, call.start_up);
    case CompensationCall::Kind::TurnOff:
      return compensator.turn_off();
    case CompensationCall::Kind::Leave:
      return compensator.leave();
    case CompensationCall::Kind::SuppressOutput:
      return compensator.suppress_output(true);
    case CompensationCall::Kind::Go:
      return compensator.suppress_output(false);
  }
}

}  // namespace

template <class Event>
void CornerBlender::give(const Event& event) {
  if constexpr (std::is_same_v<Event, CompensationCall>) {
    if (compensator_) carry_out(*compensator_, event);
  } else if constexpr (std::is_same_v<Event, UncountedEnd>) {
    if (compensator_) return compensator_->end_uncounted_block(event.origin);
    sink_->on_block_end(event.origin);
  } else if constexpr (std::is_same_v<Event, Rapid> || std::is_same_v<Event, Line>) {
    deliver_aside(event);
  } else if constexpr (!std::is_same_v<Event, CornerPlace>) {
    Forwarder{*sink_}(event);
  }
}

/// Moves aside of the plane keep the path's place in it.
template <class Move>
void CornerBlender::deliver_aside(Move move) {
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector at = in_plane(state_.given, axes);
  if (in_plane(move.to, axes) != at) set_in_plane(move.to, axes, at);
  state_.given = move.to;
  Forwarder{*sink_}(move);
}

template <class Event>
void CornerBlender::deliver(const Event& event, const Corner* corner) {
  if constexpr (std::is_same_v<Event, HeldText>) {
    Forwarder{*sink_}.give(event, state_.held.text(event));
  } else if constexpr (std::is_same_v<Event, CornerPlace>) {
    if (corner) PathWriter(*sink_, state_).put_out(*corner, state_.waiting(), event.origin);
  } else {
    give(event);
  }
}

void CornerBlender::release_held(const Corner* corner) {
  if (state_.has_end) {
    state_.has_end = false;
    sink_->on_block_end(state_.end);
  }
  if (state_.held.empty()) [[likely]]
    return;
  for (std::size_t i = 0; i < state_.held.size(); ++i) {
    std::visit([&](const auto& one) { deliver(one, corner); }, state_.held[i]);
  }
  state_.held.clear();
}

void CornerBlender::hold_or_pass(const CompensationCall& call) {
  hold_or_pass(call, Origin{});
}
void CornerBlender::turn_on(const compensation::Cutter& cutter) {
  hold_or_pass(CompensationCall{CompensationCall::Kind::TurnOn, cutter, {}});
}
void CornerBlender::turn_on(const compensation::Cutter& cutter, compensation::StartUp start_up) {
  hold_or_pass(CompensationCall{CompensationCall::Kind::TurnOnAs, cutter, start_up});
}
void CornerBlender::turn_off() {
  hold_or_pass(CompensationCall{CompensationCall::Kind::TurnOff, {}, {}});
}
void CornerBlender::leave() {
  hold_or_pass(CompensationCall{CompensationCall::Kind::Leave, {}, {}});
}
void CornerBlender::suppress_output(bool still) {
  using Kind = CompensationCall::Kind;
  hold_or_pass(CompensationCall{still ? Kind::SuppressOutput : Kind::Go, {}, {}});
}

void CornerBlender::on_program(const ProgramHeader& event) {
  if (!fault_) sink_->on_program(event);
}
void CornerBlender::on_units(const UnitsChange& event) {
  hold_or_pass(event);
}
void CornerBlender::on_dwell(const Dwell& event) {
  hold_or_pass(event);
}
void CornerBlender::on_spindle(const Spindle& event) {
  hold_or_pass(event);
}
void CornerBlender::on_coolant(const Coolant& event) {
  hold_or_pass(event);
}
void CornerBlender::on_tool(const ToolChange& event) {
  hold_or_pass(event);
}
void CornerBlender::on_miscellaneous(const Miscellaneous& event) {
  hold_or_pass(event);
}
void CornerBlender::on_pin(const PinChange& event) {
  hold_or_pass(event);
}
void CornerBlender::on_stop(const Stop& event) {
  hold_or_pass(event);
}
void CornerBlender::on_override_inhibit(const OverrideInhibit& event) {
  hold_or_pass(event);
}
void CornerBlender::on_close(const Close& event) {
  hold_or_pass(event);
}
void CornerBlender::on_output(const Output& event) {
  hold_or_pass(held(event), event.text);
}
void CornerBlender::on_open(const Open& event) {
  hold_or_pass(held(event), event.name.value_or(""));
}
void CornerBlender::on_message(const Message& event) {
  hold_or_pass(held(event), event.text);
}
void CornerBlender::on_block_end(const Origin& event) {
  if (state_.has_element && !state_.has_end && state_.held.empty() && !fault_) [[likely]] {
    state_.has_end = true;
    state_.end = event;
    return;
  }
  hold_or_pass(BlockEnd{event}, event);
}
void CornerBlender::end_uncounted_block(const Origin& event) {
  hold_or_pass(UncountedEnd{event}, event);
}

/// A thread is no element that waits, but as a line it may be led back to one.
void CornerBlender::on_thread(const Thread& event) {
  if (state_.next.back && !fault_) {
    lead_back(event);
  } else {
    settle();
  }
  if (fault_) return;
  state_.next = {};
  follow(event.to);
  sink_->on_thread(event);
}

void CornerBlender::on_probe(const Probe& event) {
  settle();
  if (fault_) return;
  if (event.result) follow(event.result->at);
  sink_->on_probe(event);
}

void CornerBlender::on_prompt(const Prompt& event) {
  settle();
  if (!fault_) sink_->on_prompt(event);
}

void CornerBlender::on_alarm(const Alarm& event) {
  settle();
  sink_->on_alarm(event);
}

void CornerBlender::on_end(const End& event) {
  settle();
  if (!fault_) sink_->on_end(event);
}

void CornerBlender::on_blank(const Blank& event) {
  if (!fault_) sink_->on_blank(event);
}

void CornerBlender::on_warning(const Warning& event) {
  if (!fault_) sink_->on_warning(event);
}

}  // namespace dripline::interpreter::blending
