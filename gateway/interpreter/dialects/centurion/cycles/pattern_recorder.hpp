#pragma once

#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter::centurion {

/// The last stage before the sink: while a cycle reads its pattern (G71-G73) the moves become the
/// pattern's, and the other functions of the machine are left to G70; otherwise everything passes.
class PatternRecorder final : public EventFilter {
 public:
  /// Both must outlive it.
  PatternRecorder(EventSink& next, ModalState& state) : EventFilter(next), state_(state) {}

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;
  void on_spindle(const Spindle& event) override;
  void on_probe(const Probe& event) override;
  void on_dwell(const Dwell& event) override { pass(&EventSink::on_dwell, event); }
  void on_coolant(const Coolant& event) override { pass(&EventSink::on_coolant, event); }
  void on_tool(const ToolChange& event) override { pass(&EventSink::on_tool, event); }
  void on_miscellaneous(const Miscellaneous& event) override {
    pass(&EventSink::on_miscellaneous, event);
  }
  void on_pin(const PinChange& event) override { pass(&EventSink::on_pin, event); }
  void on_override_inhibit(const OverrideInhibit& event) override {
    pass(&EventSink::on_override_inhibit, event);
  }
  void on_stop(const Stop& event) override { pass(&EventSink::on_stop, event); }

 private:
  bool is_reading() const { return state_.pattern.phase == PatternPhase::Reading; }
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    if (!is_reading()) (out().*deliver)(event);
  }
  void record(const PatternMove& move);
  void refuse(PatternFault fault);

  ModalState& state_;
};

}  // namespace dripline::interpreter::centurion
