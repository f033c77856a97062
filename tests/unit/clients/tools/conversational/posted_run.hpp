#pragma once

#include <cmath>
#include <string>

#include "clients/tools/conversational/post.hpp"
#include "clients/tools/conversational/reader.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::conversational {

/// `body` between a set-up in inches, as event 0, and an end that posts nothing.
inline std::string file_of(const std::string& body) {
  return "[[event]]\ntype = \"program_setup\"\nprogram = 7\n" + body +
         "\n[[event]]\ntype = \"end_of_program\"\nspindle_off = \"no\"\ncoolant_off = \"no\"\n";
}

/// What the events of `body` post, or the error.
inline std::string posted(const std::string& body, const PostOptions& options = {}) {
  const auto events = read_events(file_of(body));
  if (!events) return "error: " + events.error().what;
  const auto text = post(*events, options);
  if (!text) return "error: " + text.error().what;
  const std::string head = "O0007\nG20 G93\n";
  return text->starts_with(head) ? text->substr(head.size()) : "no head: " + *text;
}

/// One event of this type with these fields.
inline std::string event(const std::string& type, const std::string& fields) {
  return "[[event]]\ntype = \"" + type + "\"\n" + fields + "\n";
}

/// Moves as short lines in inches, X a diameter: "rapid X2 Z.1", "line X1 Z-1 at .5",
/// "arc cw X1 Z-2 about X0 Z-2".
class MoveLog final : public interpreter::EventSink {
 public:
  std::string text;

  void on_rapid(const interpreter::Rapid& event) override { add("rapid " + point(event.to)); }
  void on_line(const interpreter::Line& event) override { add("line " + point(event.to)); }
  void on_arc(const interpreter::Arc& event) override {
    add("arc " + std::string(event.turn == interpreter::Turn::Clockwise ? "cw " : "ccw ") +
        point(event.to) + " about X" + number(2 * event.center_second.inch()) + " Z" +
        number(event.center_first.inch()) + " by " + number(event.sweep.degrees()));
  }
  void on_thread(const interpreter::Thread& event) override {
    add("thread " + point(event.to) + " lead " + number(event.lead.inch()));
  }
  void on_dwell(const interpreter::Dwell& event) override { add("dwell " + number(event.seconds)); }
  void on_spindle(const interpreter::Spindle& event) override {
    constexpr const char* kStates[] = {"off", "cw", "ccw", "oriented"};
    add(std::string("spindle ") + kStates[static_cast<std::size_t>(event.state)]);
  }
  void on_coolant(const interpreter::Coolant& event) override {
    add(event.flood ? "coolant on" : "coolant off");
  }
  void on_tool(const interpreter::ToolChange& event) override {
    if (!event.is_preselection) add("tool " + std::to_string(event.number));
  }
  void on_message(const interpreter::Message& event) override {
    add("message " + std::string(event.text));
  }
  void on_stop(const interpreter::Stop&) override { add("stop"); }
  void on_alarm(const interpreter::Alarm& event) override {
    add("alarm " + std::string(event.diagnostic.id) + ' ' + std::string(event.diagnostic.text));
  }

 private:
  static std::string number(double value) { return number_text(std::round(value * 1e4) / 1e4); }
  static std::string point(const interpreter::Position& to) {
    using interpreter::Axis;
    return "X" + number(2 * to.linear(Axis::X).inch()) + " Z" + number(to.linear(Axis::Z).inch());
  }
  void add(const std::string& line) { text += line + '\n'; }
};

/// The moves of a program on the control that a setup file's text describes.
inline std::string moves_of(const std::string& program, const std::string& setup_text) {
  const auto setup = interpreter::parse_setup(setup_text, interpreter::Units::Inch);
  if (!setup) return "setup: " + setup.error().what;
  interpreter::MemorySource source(program);
  MoveLog log;
  const auto outcome =
      interpreter::run_offline(interpreter::kCenturionDialect, *setup, source, log);
  return outcome ? log.text : "not run: " + outcome.error().what + "\n" + log.text;
}

/// The moves of what `body` posts, run on the control; or why it cannot be posted or run.
/// `more` is appended to the program: others of the same file.
inline std::string run_of(const std::string& body, const std::string& setup_text = "",
                          const std::string& more = "") {
  const auto events = read_events(file_of(body));
  if (!events) return "error: " + events.error().what;
  const auto text = post(*events);
  if (!text) return "error: " + text.error().what;
  return moves_of(*text + more, "units = \"in\"\n" + setup_text);
}

}  // namespace dripline::conversational
