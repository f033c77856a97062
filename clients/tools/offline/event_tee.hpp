#pragma once

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// Delivers every event to two sinks, one after the other. Both must outlive it.
class EventTee final : public EventSink {
 public:
  EventTee(EventSink& first, EventSink& second) : first_(first), second_(second) {}

  void on_program(const ProgramHeader& event) override { both(&EventSink::on_program, event); }
  void on_units(const UnitsChange& event) override { both(&EventSink::on_units, event); }
  void on_rapid(const Rapid& event) override { both(&EventSink::on_rapid, event); }
  void on_line(const Line& event) override { both(&EventSink::on_line, event); }
  void on_arc(const Arc& event) override { both(&EventSink::on_arc, event); }
  void on_thread(const Thread& event) override { both(&EventSink::on_thread, event); }
  void on_dwell(const Dwell& event) override { both(&EventSink::on_dwell, event); }
  void on_spindle(const Spindle& event) override { both(&EventSink::on_spindle, event); }
  void on_coolant(const Coolant& event) override { both(&EventSink::on_coolant, event); }
  void on_tool(const ToolChange& event) override { both(&EventSink::on_tool, event); }
  void on_blank(const Blank& event) override { both(&EventSink::on_blank, event); }
  void on_miscellaneous(const Miscellaneous& event) override {
    both(&EventSink::on_miscellaneous, event);
  }
  void on_pin(const PinChange& event) override { both(&EventSink::on_pin, event); }
  void on_probe(const Probe& event) override { both(&EventSink::on_probe, event); }
  void on_output(const Output& event) override { both(&EventSink::on_output, event); }
  void on_open(const Open& event) override { both(&EventSink::on_open, event); }
  void on_close(const Close& event) override { both(&EventSink::on_close, event); }
  void on_message(const Message& event) override { both(&EventSink::on_message, event); }
  void on_prompt(const Prompt& event) override { both(&EventSink::on_prompt, event); }
  void on_stop(const Stop& event) override { both(&EventSink::on_stop, event); }
  void on_override_inhibit(const OverrideInhibit& event) override {
    both(&EventSink::on_override_inhibit, event);
  }
  void on_warning(const Warning& event) override { both(&EventSink::on_warning, event); }
  void on_alarm(const Alarm& event) override { both(&EventSink::on_alarm, event); }
  void on_end(const End& event) override { both(&EventSink::on_end, event); }
  void on_block_end(const Origin& event) override { both(&EventSink::on_block_end, event); }

 private:
  template <class Event>
  void both(void (EventSink::*deliver)(const Event&), const Event& event) {
    (first_.*deliver)(event);
    (second_.*deliver)(event);
  }
  EventSink& first_;
  EventSink& second_;
};

}  // namespace dripline::interpreter
