#pragma once

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// Forwards every event; a stage that derives from it changes some of them. The sink must outlive
/// it.
class EventFilter : public EventSink {
 public:
  explicit EventFilter(EventSink& out) : out_(out) {}

  void on_program(const ProgramHeader& event) override { out_.on_program(event); }
  void on_units(const UnitsChange& event) override { out_.on_units(event); }
  void on_rapid(const Rapid& event) override { out_.on_rapid(event); }
  void on_line(const Line& event) override { out_.on_line(event); }
  void on_arc(const Arc& event) override { out_.on_arc(event); }
  void on_thread(const Thread& event) override { out_.on_thread(event); }
  void on_dwell(const Dwell& event) override { out_.on_dwell(event); }
  void on_spindle(const Spindle& event) override { out_.on_spindle(event); }
  void on_coolant(const Coolant& event) override { out_.on_coolant(event); }
  void on_tool(const ToolChange& event) override { out_.on_tool(event); }
  void on_blank(const Blank& event) override { out_.on_blank(event); }
  void on_miscellaneous(const Miscellaneous& event) override { out_.on_miscellaneous(event); }
  void on_pin(const PinChange& event) override { out_.on_pin(event); }
  void on_probe(const Probe& event) override { out_.on_probe(event); }
  void on_output(const Output& event) override { out_.on_output(event); }
  void on_open(const Open& event) override { out_.on_open(event); }
  void on_close(const Close& event) override { out_.on_close(event); }
  void on_message(const Message& event) override { out_.on_message(event); }
  void on_prompt(const Prompt& event) override { out_.on_prompt(event); }
  void on_stop(const Stop& event) override { out_.on_stop(event); }
  void on_override_inhibit(const OverrideInhibit& event) override {
    out_.on_override_inhibit(event);
  }
  void on_warning(const Warning& event) override { out_.on_warning(event); }
  void on_alarm(const Alarm& event) override { out_.on_alarm(event); }
  void on_end(const End& event) override { out_.on_end(event); }
  void on_block_end(const Origin& event) override { out_.on_block_end(event); }

 protected:
  EventSink& out() { return out_; }

 private:
  EventSink& out_;
};

/// Forwards events while it is open.
class EventGate : public EventFilter {
 public:
  using EventFilter::EventFilter;

  void on_program(const ProgramHeader& event) override { pass(&EventSink::on_program, event); }
  void on_units(const UnitsChange& event) override { pass(&EventSink::on_units, event); }
  void on_rapid(const Rapid& event) override { pass(&EventSink::on_rapid, event); }
  void on_line(const Line& event) override { pass(&EventSink::on_line, event); }
  void on_arc(const Arc& event) override { pass(&EventSink::on_arc, event); }
  void on_thread(const Thread& event) override { pass(&EventSink::on_thread, event); }
  void on_dwell(const Dwell& event) override { pass(&EventSink::on_dwell, event); }
  void on_spindle(const Spindle& event) override { pass(&EventSink::on_spindle, event); }
  void on_coolant(const Coolant& event) override { pass(&EventSink::on_coolant, event); }
  void on_tool(const ToolChange& event) override { pass(&EventSink::on_tool, event); }
  void on_blank(const Blank& event) override { pass(&EventSink::on_blank, event); }
  void on_miscellaneous(const Miscellaneous& event) override {
    pass(&EventSink::on_miscellaneous, event);
  }
  void on_pin(const PinChange& event) override { pass(&EventSink::on_pin, event); }
  void on_probe(const Probe& event) override { pass(&EventSink::on_probe, event); }
  void on_output(const Output& event) override { pass(&EventSink::on_output, event); }
  void on_open(const Open& event) override { pass(&EventSink::on_open, event); }
  void on_close(const Close& event) override { pass(&EventSink::on_close, event); }
  void on_message(const Message& event) override { pass(&EventSink::on_message, event); }
  void on_prompt(const Prompt& event) override { pass(&EventSink::on_prompt, event); }
  void on_stop(const Stop& event) override { pass(&EventSink::on_stop, event); }
  void on_override_inhibit(const OverrideInhibit& event) override {
    pass(&EventSink::on_override_inhibit, event);
  }
  void on_warning(const Warning& event) override { pass(&EventSink::on_warning, event); }
  void on_alarm(const Alarm& event) override { pass(&EventSink::on_alarm, event); }
  void on_end(const End& event) override { pass(&EventSink::on_end, event); }
  void on_block_end(const Origin& event) override { pass(&EventSink::on_block_end, event); }

 protected:
  virtual bool is_open() const = 0;

 private:
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    if (is_open()) (out().*deliver)(event);
  }
};

}  // namespace dripline::interpreter
