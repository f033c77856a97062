#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/stages/compensation/policy.hpp"
#include "gateway/interpreter/stages/look_ahead/held_events.hpp"
#include "protocol/base/result.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter::look_ahead {

/// The rule that a contour breaks, one of the stage's `Kind`s, and where.
template <class Kind>
struct ContourFault {
  Kind kind{};
  Origin origin{};            ///< the element that cannot be carried out
  Origin next{};              ///< the element that showed it; the same one where no other took part
  Length value{}, limit{};    ///< `Kind` states what they are
  bool first_is_arc = false;  ///< the element before the corner
  bool next_is_arc = false;   ///< the element after it
};

/// More than the state of any stage takes.
inline constexpr std::size_t kMaxStateBytes = 64 * 1024;

/// The part of its state that every stage has.
template <class Element, class Held>
struct StageState {
  bool has_element = false;  ///< a move in the plane waits for the next one
  std::uint8_t waiting_slot = 0;
  Plane plane = Plane::XY;
  Position programmed;  ///< where the program takes the machine to be
  Position sent;        ///< where the moves given out lead
  Held held;
  std::array<Element, 2> elements;

  /// The element that waits, when there is one; the other slot is the next one's.
  Element& waiting() { return elements[waiting_slot]; }
  const Element& waiting() const { return elements[waiting_slot]; }
  Element& spare() { return elements[1 - waiting_slot]; }
  void swap_elements() { waiting_slot = static_cast<std::uint8_t>(1 - waiting_slot); }
};

/// A stage of a dialect that sees one move ahead. A move in the plane waits until the next one
/// decides its end; all events in between, block ends included, wait with it and keep their order.
/// This class has all but the moves; `Stage`, which derives from it, adds
/// - `flush()`: ends the waiting move without its successor;
/// - `follow(position)`: the machine is where the program takes it to be;
/// - `make_room(origin)`: the held events are full. Flushes, or refuses and gives false;
/// - `keep_in_plane(position)`: a move outside the plane keeps the path's point in it;
/// - `deliver_own(event)`, for the kinds of events that only this stage holds.
///
/// The stage is known at compile time, so that nothing between two moves costs a virtual call
/// besides the sink's. Bounded and without allocation, except for the bytes of a snapshot. Not
/// thread-safe. After a fault nothing more is given out until `reset`, but for alarms.
template <class Stage, class State, class FaultKind>
class LookAheadStage : public compensation::CompensationSink {
 public:
  /// A move waits for the next one.
  bool is_waiting() const { return state_.has_element; }
  /// Set by the event that broke a rule.
  const std::optional<ContourFault<FaultKind>>& fault() const { return fault_; }
  /// Where the moves given out so far lead.
  const Position& sent() const { return state_.sent; }
  /// The machine is elsewhere than the events say (a reference point, a restart).
  void place(const Position& at) {
    stage().flush();
    stage().follow(at);
  }

  /// The state at a block boundary, for a snapshot: equal bytes mean equal states. At most
  /// kMaxStateBytes.
  std::vector<std::byte> state() const;
  /// Errors: Corrupt; the state is then unchanged.
  Result<void> restore(const std::vector<std::byte>& bytes);

  void on_units(const UnitsChange& event) override { hold_or_deliver(event); }
  void on_dwell(const Dwell& event) override { hold_or_deliver(event); }
  void on_spindle(const Spindle& event) override { hold_or_deliver(event); }
  void on_coolant(const Coolant& event) override { hold_or_deliver(event); }
  void on_tool(const ToolChange& event) override { hold_or_deliver(event); }
  void on_miscellaneous(const Miscellaneous& event) override { hold_or_deliver(event); }
  void on_pin(const PinChange& event) override { hold_or_deliver(event); }
  void on_stop(const Stop& event) override { hold_or_deliver(event); }
  void on_override_inhibit(const OverrideInhibit& event) override { hold_or_deliver(event); }
  void on_close(const Close& event) override { hold_or_deliver(event); }
  void on_output(const Output& event) override { hold_or_deliver(held(event), event.text); }
  void on_open(const Open& event) override {
    hold_or_deliver(held(event), event.name.value_or(""));
  }
  void on_message(const Message& event) override { hold_or_deliver(held(event), event.text); }

  /// These need the tool in its place: the waiting move is flushed first.
  void on_thread(const Thread& event) override {
    stage().flush();
    if (fault_) return;
    stage().follow(event.to);
    sink_->on_thread(event);
  }
  void on_probe(const Probe& event) override {
    stage().flush();
    if (fault_) return;
    if (event.result) stage().follow(event.result->at);
    sink_->on_probe(event);
  }
  void on_prompt(const Prompt& event) override {
    stage().flush();
    if (!fault_) sink_->on_prompt(event);
  }
  void on_end(const End& event) override {
    stage().flush();
    if (!fault_) sink_->on_end(event);
  }
  void on_alarm(const Alarm& event) override {
    stage().flush();
    sink_->on_alarm(event);
  }

  /// About the text, not the motion: delivered at once.
  void on_program(const ProgramHeader& event) override {
    if (!fault_) sink_->on_program(event);
  }
  void on_blank(const Blank& event) override {
    if (!fault_) sink_->on_blank(event);
  }
  void on_warning(const Warning& event) override {
    if (!fault_) sink_->on_warning(event);
  }

 protected:
  explicit LookAheadStage(EventSink& sink) : sink_(&sink) {}

  template <class Event>
  void hold_or_deliver(const Event& event, const Origin& origin) {
    if (fault_) return;
    if (state_.has_element && (state_.held.push(event) || !stage().make_room(origin))) return;
    deliver(event);
  }
  template <class Event>
  void hold_or_deliver(const Event& event) {
    hold_or_deliver(event, event.origin);
  }
  void hold_or_deliver(const HeldText& event, std::string_view text) {
    if (fault_) return;
    if (state_.has_element && (state_.held.push(event, text) || !stage().make_room(event.origin)))
      return;
    Forwarder{*sink_}.give(event, text);
  }

  /// A move of axes outside the plane. The programmed point in the plane stays, so that many moves
  /// too short to be elements add up to one that is.
  template <class Move>
  void hold_off_plane(const Move& move) {
    const PlaneAxes axes = axes_of(state_.plane);
    const PlaneVector from = in_plane(state_.programmed, axes);
    state_.programmed = move.to;
    set_in_plane(state_.programmed, axes, from);
    hold_or_deliver(move);
  }

  template <class Event>
  void deliver(const Event& event) {
    if constexpr (std::is_same_v<Event, HeldText>) {
      Forwarder{*sink_}.give(event, state_.held.text(event));
    } else if constexpr (std::is_same_v<Event, Rapid> || std::is_same_v<Event, Line>) {
      Event move = event;
      stage().keep_in_plane(move.to);
      state_.sent = move.to;
      Forwarder{*sink_}(move);
    } else if constexpr (std::is_invocable_v<Forwarder, const Event&>) {
      Forwarder{*sink_}(event);
    } else {
      stage().deliver_own(event);
    }
  }

  void deliver_held() {
    for (std::size_t i = 0; i < state_.held.size(); ++i) {
      std::visit([this](const auto& event) { this->deliver(event); }, state_.held[i]);
    }
    state_.held.clear();
  }

  /// Always false.
  bool refuse(const ContourFault<FaultKind>& fault) {
    fault_ = fault;
    return false;
  }

  EventSink* sink_;
  std::optional<ContourFault<FaultKind>> fault_;
  State state_;

 private:
  Stage& stage() { return static_cast<Stage&>(*this); }
};

}  // namespace dripline::interpreter::look_ahead
