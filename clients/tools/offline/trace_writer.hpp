#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// Writes what a program does as a trace: one JSON object per line, in execution order. Lengths
/// leave in the program's units, X doubled where the program writes it as a diameter. Relies on the
/// interpreter to deliver on_program before anything else; a change of units before the first
/// motion belongs into that header. Not printed: moves of zero length that are no full circles, and
/// probe questions without their result. One thread; no allocation for motion once the buffer has
/// grown.
class TraceWriter final : public EventSink {
 public:
  /// Takes whole lines, several at once, each with its end.
  using Write = std::function<void(std::string_view)>;

  /// `start`: position of the machine before the first move (Setup::start).
  explicit TraceWriter(Write write, const Position& start = {});
  ~TraceWriter() override { flush(); }
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// Hands over what is still in the buffer. Done at the end, at an alarm and by the destructor.
  void flush();

  void on_program(const ProgramHeader&) override;
  void on_units(const UnitsChange&) override;
  void on_rapid(const Rapid&) override;
  void on_line(const Line&) override;
  void on_arc(const Arc&) override;
  void on_thread(const Thread&) override;
  void on_dwell(const Dwell&) override;
  void on_spindle(const Spindle&) override;
  void on_coolant(const Coolant&) override;
  void on_tool(const ToolChange&) override;
  void on_blank(const Blank&) override;
  void on_miscellaneous(const Miscellaneous&) override;
  void on_pin(const PinChange&) override;
  void on_probe(const Probe&) override;
  void on_output(const Output&) override;
  void on_open(const Open&) override;
  void on_close(const Close&) override;
  void on_message(const Message&) override;
  void on_prompt(const Prompt&) override;
  void on_stop(const Stop&) override;
  void on_warning(const Warning&) override;
  void on_alarm(const Alarm&) override;
  void on_end(const End&) override;

 private:
  void begin(std::string_view event, const Origin& origin);
  void end();
  void member(std::string_view name);
  void member(std::string_view name, double value);
  void member(std::string_view name, int value);
  void member(std::string_view name, bool value);
  void member(std::string_view name, std::string_view value);
  void position(std::string_view name, const Position& position);
  void corner(std::string_view name, const Position& corner);
  void coordinate(Axis axis, double raw);
  /// In the units in force, or in degrees.
  void feed(const Feed& feed, bool is_of_degrees = false);
  void arc_path(const Arc& arc);
  void diagnostic(const Diagnostic& diagnostic);
  /// Length in the units in force.
  double in_units(Length length) const;
  /// Whether rotary axes move alone.
  bool is_turn(const Position& to) const;
  /// Remembers where a move went; true when it went anywhere.
  bool moves_to(const Position& to);

  Write write_;
  std::string buffer_;
  Position last_;  ///< the machine after the last move; its axes are those that have moved
  bool is_inch_ = false;
  double x_scale_ = 1;  ///< 2 where X is a diameter
};

}  // namespace dripline::interpreter
