#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

/// Radius compensation of the later program knows the end of a move only when it has seen the next:
/// the last move of the plane waits here with all events that came after it, in order. In contrast
/// to the stages' list, this one holds arcs and threads, up to this control's own limit.
namespace dripline::interpreter::rs274ngc {

class HeldEvents final : public EventSink {
 public:
  struct Text {
    look_ahead::HeldText head;
    std::string text;
  };
  using Event =
      std::variant<Rapid, Line, Arc, Dwell, Spindle, Coolant, ToolChange, Miscellaneous, Stop,
                   UnitsChange, Close, Text, look_ahead::BlockEnd, Thread, OverrideInhibit>;
  static constexpr std::size_t kMax = 1000;

  bool empty() const { return events_.empty(); }
  bool is_full() const { return events_.size() >= kMax; }
  std::size_t size() const { return events_.size(); }
  const std::vector<Event>& events() const { return events_; }
  std::vector<Event>& events() { return events_; }
  /// Begins to hold: `start` is where the move, which is the first of the events, begins.
  void begin(const Position& start) { start_ = start; }
  const Position& start() const { return start_; }
  Position& start() { return start_; }
  /// Delivers all in order; then nothing is held.
  void release(EventSink& sink);
  void drop() { events_.clear(); }

  void on_rapid(const Rapid& event) override { events_.emplace_back(event); }
  void on_line(const Line& event) override { events_.emplace_back(event); }
  void on_arc(const Arc& event) override { events_.emplace_back(event); }
  void on_thread(const Thread& event) override { events_.emplace_back(event); }
  void on_dwell(const Dwell& event) override { events_.emplace_back(event); }
  void on_spindle(const Spindle& event) override { events_.emplace_back(event); }
  void on_coolant(const Coolant& event) override { events_.emplace_back(event); }
  void on_tool(const ToolChange& event) override { events_.emplace_back(event); }
  void on_miscellaneous(const Miscellaneous& event) override { events_.emplace_back(event); }
  void on_stop(const Stop& event) override { events_.emplace_back(event); }
  void on_override_inhibit(const OverrideInhibit& event) override { events_.emplace_back(event); }
  void on_units(const UnitsChange& event) override { events_.emplace_back(event); }
  void on_close(const Close& event) override { events_.emplace_back(event); }
  void on_message(const Message& event) override { hold(event, event.text); }
  void on_output(const Output& event) override { hold(event, event.text); }
  void on_open(const Open& event) override { hold(event, event.name.value_or("")); }
  void on_block_end(const Origin& origin) override {
    events_.emplace_back(look_ahead::BlockEnd{origin});
  }

 private:
  template <class TextEvent>
  void hold(const TextEvent& event, std::string_view text) {
    events_.emplace_back(Text{look_ahead::held(event), std::string(text)});
  }

  std::vector<Event> events_;
  Position start_;
};

}  // namespace dripline::interpreter::rs274ngc
