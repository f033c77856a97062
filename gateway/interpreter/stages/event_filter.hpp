#pragma once

#include "gateway/interpreter/core/event.hpp"

/// Sinks that treat most kinds of events alike.
namespace dripline::interpreter {

/// Hands every event to `Derived::pass(deliver, event)`, where `deliver` is the function of a sink
/// that takes this kind.
template <class Derived>
class EventRelay : public EventSink {
 public:
  void on_program(const ProgramHeader& event) override { relay(&EventSink::on_program, event); }
  void on_units(const UnitsChange& event) override { relay(&EventSink::on_units, event); }
  void on_rapid(const Rapid& event) override { relay(&EventSink::on_rapid, event); }
  void on_line(const Line& event) override { relay(&EventSink::on_line, event); }
  void on_arc(const Arc& event) override { relay(&EventSink::on_arc, event); }
  void on_thread(const Thread& event) override { relay(&EventSink::on_thread, event); }
  void on_dwell(const Dwell& event) override { relay(&EventSink::on_dwell, event); }
  void on_spindle(const Spindle& event) override { relay(&EventSink::on_spindle, event); }
  void on_coolant(const Coolant& event) override { relay(&EventSink::on_coolant, event); }
  void on_tool(const ToolChange& event) override { relay(&EventSink::on_tool, event); }
  void on_blank(const Blank& event) override { relay(&EventSink::on_blank, event); }
  void on_miscellaneous(const Miscellaneous& event) override {
    relay(&EventSink::on_miscellaneous, event);
  }
  void on_pin(const PinChange& event) override { relay(&EventSink::on_pin, event); }
  void on_probe(const Probe& event) override { relay(&EventSink::on_probe, event); }
  void on_output(const Output& event) override { relay(&EventSink::on_output, event); }
  void on_open(const Open& event) override { relay(&EventSink::on_open, event); }
  void on_close(const Close& event) override { relay(&EventSink::on_close, event); }
  void on_message(const Message& event) override { relay(&EventSink::on_message, event); }
  void on_prompt(const Prompt& event) override { relay(&EventSink::on_prompt, event); }
  void on_stop(const Stop& event) override { relay(&EventSink::on_stop, event); }
  void on_override_inhibit(const OverrideInhibit& event) override {
    relay(&EventSink::on_override_inhibit, event);
  }
  void on_warning(const Warning& event) override { relay(&EventSink::on_warning, event); }
  void on_alarm(const Alarm& event) override { relay(&EventSink::on_alarm, event); }
  void on_end(const End& event) override { relay(&EventSink::on_end, event); }
  void on_block_end(const Origin& event) override { relay(&EventSink::on_block_end, event); }

 private:
  template <class Event>
  void relay(void (EventSink::*deliver)(const Event&), const Event& event) {
    static_cast<Derived&>(*this).pass(deliver, event);
  }
};

/// Forwards every event; a stage that derives from it changes some of them. The sink must outlive
/// it.
class EventFilter : public EventRelay<EventFilter> {
 public:
  explicit EventFilter(EventSink& out) : out_(out) {}

 protected:
  EventSink& out() { return out_; }

 private:
  friend EventRelay;
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    (out_.*deliver)(event);
  }

  EventSink& out_;
};

/// Forwards events while it is open.
class EventGate : public EventRelay<EventGate> {
 public:
  explicit EventGate(EventSink& out) : out_(out) {}

 protected:
  EventSink& out() { return out_; }
  virtual bool is_open() const = 0;

 private:
  friend EventRelay;
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    if (is_open()) (out_.*deliver)(event);
  }

  EventSink& out_;
};

}  // namespace dripline::interpreter
