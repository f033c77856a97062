#pragma once

#include "gateway/interpreter/event.hpp"

namespace dripline::interpreter::centurion {

/// Gives every event on; a stage overrides those it changes.
class PassingSink : public EventSink {
 public:
  explicit PassingSink(EventSink& next) : next_(&next) {}
  void lead_to(EventSink& next) { next_ = &next; }

  void on_program(const ProgramHeader& event) override { next_->on_program(event); }
  void on_units(const UnitsChange& event) override { next_->on_units(event); }
  void on_rapid(const Rapid& event) override { next_->on_rapid(event); }
  void on_line(const Line& event) override { next_->on_line(event); }
  void on_arc(const Arc& event) override { next_->on_arc(event); }
  void on_thread(const Thread& event) override { next_->on_thread(event); }
  void on_dwell(const Dwell& event) override { next_->on_dwell(event); }
  void on_spindle(const Spindle& event) override { next_->on_spindle(event); }
  void on_coolant(const Coolant& event) override { next_->on_coolant(event); }
  void on_tool(const ToolChange& event) override { next_->on_tool(event); }
  void on_miscellaneous(const Miscellaneous& event) override { next_->on_miscellaneous(event); }
  void on_pin(const PinChange& event) override { next_->on_pin(event); }
  void on_probe(const Probe& event) override { next_->on_probe(event); }
  void on_output(const Output& event) override { next_->on_output(event); }
  void on_open(const Open& event) override { next_->on_open(event); }
  void on_close(const Close& event) override { next_->on_close(event); }
  void on_message(const Message& event) override { next_->on_message(event); }
  void on_prompt(const Prompt& event) override { next_->on_prompt(event); }
  void on_stop(const Stop& event) override { next_->on_stop(event); }
  void on_blank(const Blank& event) override { next_->on_blank(event); }
  void on_panel_lock(const PanelLock& event) override { next_->on_panel_lock(event); }
  void on_warning(const Warning& event) override { next_->on_warning(event); }
  void on_alarm(const Alarm& event) override { next_->on_alarm(event); }
  void on_end(const End& event) override { next_->on_end(event); }
  void on_block_end(const Origin& event) override { next_->on_block_end(event); }

 protected:
  EventSink& next() { return *next_; }

 private:
  EventSink* next_;
};

}  // namespace dripline::interpreter::centurion
