#include <type_traits>

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// The events that only pass through: at once, or after the move that waits.
namespace dripline::interpreter::compensation {

using namespace impl;
using look_ahead::BlockEnd;
using look_ahead::Forwarder;
using look_ahead::held;
using look_ahead::HeldText;

template <class Event>
void Compensator::hold(const Event& event, const Origin& origin) {
  if (!state_.held.push(event))
    refuse({FaultKind::TooMuchBetween, state_.waiting().origin, origin, {}, {}});
}

template void Compensator::hold(const Rapid& event, const Origin& origin);
template void Compensator::hold(const Line& event, const Origin& origin);

template <class Event>
void Compensator::hold_or_pass(const Event& event) {
  if (fault_) return;
  if (state_.has_element) {
    hold(event, event.origin);
  } else {
    Forwarder{sink_}(event);
  }
}

void Compensator::hold_or_pass(HeldText text, std::string_view content) {
  if (fault_) return;
  if (!state_.has_element) return Forwarder{sink_}.give(text, content);
  if (!state_.held.push(text, content))
    refuse({FaultKind::TooMuchBetween, state_.waiting().origin, text.origin, {}, {}});
}

void Compensator::release_held() {
  for (std::size_t i = 0; i < state_.held.size(); ++i) deliver(state_.held[i]);
  state_.held.clear();
}

void Compensator::deliver(const HeldEvent& event) {
  const Forwarder giver{sink_};
  std::visit(
      [&](const auto& one) {
        using Event = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<Event, HeldText>) {
          giver.give(one, state_.held.text(one));
        } else if constexpr (std::is_same_v<Event, Rapid> || std::is_same_v<Event, Line>) {
          deliver_aside(one);
        } else {
          giver(one);
        }
      },
      event);
}

/// Moves aside of the plane keep the tool's place in it.
template <class Move>
void Compensator::deliver_aside(Move move) {
  const PlaneAxes axes = axes_of(state_.plane);
  set_in_plane(move.to, axes, in_plane(state_.tool, axes));
  state_.tool = move.to;
  Forwarder{sink_}(move);
}
template void Compensator::deliver_aside(Rapid move);
template void Compensator::deliver_aside(Line move);

void Compensator::on_program(const ProgramHeader& event) {
  if (!fault_) sink_.on_program(event);
}
void Compensator::on_units(const UnitsChange& event) {
  hold_or_pass(event);
}
void Compensator::on_dwell(const Dwell& event) {
  hold_or_pass(event);
}
void Compensator::on_spindle(const Spindle& event) {
  hold_or_pass(event);
}
void Compensator::on_coolant(const Coolant& event) {
  hold_or_pass(event);
}
void Compensator::on_tool(const ToolChange& event) {
  hold_or_pass(event);
}
void Compensator::on_miscellaneous(const Miscellaneous& event) {
  hold_or_pass(event);
}
void Compensator::on_pin(const PinChange& event) {
  hold_or_pass(event);
}
void Compensator::on_stop(const Stop& event) {
  hold_or_pass(event);
}
void Compensator::on_override_inhibit(const OverrideInhibit& event) {
  hold_or_pass(event);
}
void Compensator::on_close(const Close& event) {
  hold_or_pass(event);
}

void Compensator::on_output(const Output& event) {
  hold_or_pass(held(event), event.text);
}
void Compensator::on_open(const Open& event) {
  hold_or_pass(held(event), event.name.value_or(""));
}
void Compensator::on_message(const Message& event) {
  hold_or_pass(held(event), event.text);
}

void Compensator::end_uncounted_block(const Origin& event) {
  hold_or_pass(BlockEnd{event});
}

void Compensator::on_block_end(const Origin& event) {
  hold_or_pass(BlockEnd{event});
  if (!state_.has_element || event.block == state_.waiting().origin.block) return;
  if (++state_.idle_blocks > policy_.blocks_without_motion) settle();
}

void Compensator::on_thread(const Thread& event) {
  settle();
  if (fault_) return;
  follow(event.to);
  sink_.on_thread(event);
}

void Compensator::on_probe(const Probe& event) {
  settle();
  if (fault_) return;
  if (event.result) follow(event.result->at);
  sink_.on_probe(event);
}

void Compensator::on_prompt(const Prompt& event) {
  settle();
  if (!fault_) sink_.on_prompt(event);
}

void Compensator::on_alarm(const Alarm& event) {
  settle();
  sink_.on_alarm(event);
}

void Compensator::on_end(const End& event) {
  settle();
  if (!fault_) sink_.on_end(event);
}

void Compensator::on_blank(const Blank& event) {
  if (!fault_) sink_.on_blank(event);
}

void Compensator::on_warning(const Warning& event) {
  if (!fault_) sink_.on_warning(event);
}

}  // namespace dripline::interpreter::compensation
