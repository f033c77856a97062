#pragma once

#include <string>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// Keeps every event as one line of text with all its members at full precision, block ends
/// included: two runs that did the same have equal logs.
class EventLog final : public EventSink {
 public:
  const std::vector<std::string>& lines() const { return lines_; }

  void on_program(const ProgramHeader& event) override;
  void on_units(const UnitsChange& event) override;
  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;
  void on_dwell(const Dwell& event) override;
  void on_spindle(const Spindle& event) override;
  void on_coolant(const Coolant& event) override;
  void on_tool(const ToolChange& event) override;
  void on_blank(const Blank& event) override;
  void on_miscellaneous(const Miscellaneous& event) override;
  void on_pin(const PinChange& event) override;
  void on_probe(const Probe& event) override;
  void on_output(const Output& event) override;
  void on_open(const Open& event) override;
  void on_close(const Close& event) override;
  void on_message(const Message& event) override;
  void on_prompt(const Prompt& event) override;
  void on_stop(const Stop& event) override;
  void on_override_inhibit(const OverrideInhibit& event) override;
  void on_warning(const Warning& event) override;
  void on_alarm(const Alarm& event) override;
  void on_end(const End& event) override;
  void on_block_end(const Origin& event) override;

 private:
  void add(const char* name, const Origin& origin, std::string members);

  std::vector<std::string> lines_;
};

}  // namespace dripline::interpreter
