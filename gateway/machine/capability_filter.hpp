#pragma once

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::machine {

/// Between the interpreter and a back end: an event that the back end cannot execute becomes an
/// alarm (MCH0008) in its place, so that everything before it is still executed and nothing after
/// it is. Both parameters must outlive it.
class CapabilityFilter final : public interpreter::EventSink {
 public:
  CapabilityFilter(const MotionCapabilities& capabilities, interpreter::EventSink& to)
      : capabilities_(capabilities), to_(to) {}

  void on_line(const interpreter::Line& line) override;
  void on_arc(const interpreter::Arc& arc) override;
  void on_thread(const interpreter::Thread& thread) override;
  void on_dwell(const interpreter::Dwell& dwell) override;

  void on_program(const interpreter::ProgramHeader& event) override { to_.on_program(event); }
  void on_units(const interpreter::UnitsChange& event) override { to_.on_units(event); }
  void on_rapid(const interpreter::Rapid& event) override { to_.on_rapid(event); }
  void on_spindle(const interpreter::Spindle& event) override { to_.on_spindle(event); }
  void on_coolant(const interpreter::Coolant& event) override { to_.on_coolant(event); }
  void on_tool(const interpreter::ToolChange& event) override { to_.on_tool(event); }
  void on_blank(const interpreter::Blank& event) override { to_.on_blank(event); }
  void on_miscellaneous(const interpreter::Miscellaneous& event) override {
    to_.on_miscellaneous(event);
  }
  void on_pin(const interpreter::PinChange& event) override { to_.on_pin(event); }
  void on_probe(const interpreter::Probe& event) override { to_.on_probe(event); }
  void on_output(const interpreter::Output& event) override { to_.on_output(event); }
  void on_open(const interpreter::Open& event) override { to_.on_open(event); }
  void on_close(const interpreter::Close& event) override { to_.on_close(event); }
  void on_message(const interpreter::Message& event) override { to_.on_message(event); }
  void on_prompt(const interpreter::Prompt& event) override { to_.on_prompt(event); }
  void on_stop(const interpreter::Stop& event) override { to_.on_stop(event); }
  void on_override_inhibit(const interpreter::OverrideInhibit& event) override {
    to_.on_override_inhibit(event);
  }
  void on_warning(const interpreter::Warning& event) override { to_.on_warning(event); }
  void on_alarm(const interpreter::Alarm& event) override { to_.on_alarm(event); }
  void on_end(const interpreter::End& event) override { to_.on_end(event); }
  void on_block_end(const interpreter::Origin& origin) override { to_.on_block_end(origin); }

  /// The alarm of a missing capability, for what is asked of the owner instead (a probe).
  void refuse(const interpreter::Origin& origin, std::string_view what);

 private:
  bool has_feed(const interpreter::Origin& origin, Feed feed);

  const MotionCapabilities& capabilities_;
  interpreter::EventSink& to_;
};

}  // namespace dripline::machine
