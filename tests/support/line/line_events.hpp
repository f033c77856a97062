#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/wire/discipline.hpp"

namespace dripline::test_support {

/// One line an event, texts that follow each other joined:
///   receiving 15 | sending | text "G0\nM30\n" | received | sent | stopped | resumed | accepted 128
///   failed timeout: ... | error corrupt: ... | wants a program 15 | sends a program | wants the
///   directory
std::string event_lines(const std::vector<wire::Event>& events);

/// Appends to `lines` what came since; texts are joined across calls.
class EventLog {
 public:
  void add(const std::vector<wire::Event>& events);
  std::string text() const { return event_lines(events_); }
  void clear() { events_.clear(); }

 private:
  std::vector<wire::Event> events_;
};

/// One end driven by a test: time, input and output.
struct TestedLine {
  std::unique_ptr<wire::Discipline> line;
  wire::LineTime now{};

  /// Errors end the test's process: the settings are the test's own.
  TestedLine(const wire::LineSettings& settings, wire::Role role);
  void hear(std::string_view characters);
  void hear_fault(wire::LineFault fault) { line->fault(fault, now); }
  /// Up to `after` from now, ticking when it wants to be.
  void pass(wire::LineTime after);
  /// Everything that may leave now, as if the line had no rate; pauses are waited for.
  std::string say(std::size_t at_most = 1 << 20);
  /// What leaves without time passing.
  std::string say_now(std::size_t at_most = 1 << 20);
  std::string events() { return event_lines(line->take_events()); }
  Result<void> offer(std::string_view text, bool is_last = true) {
    return line->offer(text, is_last, now);
  }
};

}  // namespace dripline::test_support
