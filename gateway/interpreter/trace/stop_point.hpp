#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/event.hpp"

namespace dripline::interpreter {

/// Where an offline run may end early: behind the first block of the started program that has this
/// number, or that begins in this line.
struct StopPoint {
  std::optional<std::int64_t> sequence;
  std::optional<std::uint64_t> line;

  bool is_at(const Origin& origin) const {
    if (origin.program != kMainProgram) return false;
    return sequence ? origin.sequence == *sequence : line && origin.line == *line;
  }
};

/// Delivers events to a sink up to the end of the block at a stop point, and nothing behind it: an
/// interpreter that looks ahead is then further on. The sink must outlive it.
class StopGate final : public EventSink {
 public:
  StopGate(EventSink& sink, StopPoint stop) : sink_(sink), stop_(stop) {}

  bool has_stopped() const { return has_stopped_; }

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
  void on_panel_lock(const PanelLock& event) override { pass(&EventSink::on_panel_lock, event); }
  void on_warning(const Warning& event) override { pass(&EventSink::on_warning, event); }
  void on_alarm(const Alarm& event) override { pass(&EventSink::on_alarm, event); }
  void on_end(const End& event) override { pass(&EventSink::on_end, event); }
  void on_block_end(const Origin& event) override {
    pass(&EventSink::on_block_end, event);
    has_stopped_ |= stop_.is_at(event);
  }

 private:
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    if (!has_stopped_) (sink_.*deliver)(event);
  }
  EventSink& sink_;
  StopPoint stop_;
  bool has_stopped_ = false;
};

}  // namespace dripline::interpreter
