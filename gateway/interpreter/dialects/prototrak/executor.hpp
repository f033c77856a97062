#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gateway/interpreter/core/language/loop_guard.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/prototrak/contour.hpp"
#include "gateway/interpreter/dialects/prototrak/event_list.hpp"
#include "gateway/interpreter/stages/compensation/compensator.hpp"

namespace dripline::interpreter::prototrak {

inline constexpr std::size_t kMaxNesting = 10;

/// The `[control]` options: how the operator works the machine.
struct ControlOptions {
  bool waits = true;  ///< for the operator at positions and at begin and end of a chain of cuts
  std::uint16_t start_event = 1;  ///< the first that is executed
  bool names_start = false;       ///< it was named, and the operator is asked there
};
/// Errors: Syntax, Unsupported, naming the option.
Result<ControlOptions> read_options(const Setup& setup);

/// A range of events being executed, several times over.
struct Frame {
  std::uint16_t first = 1, last = 0, index = 1;  ///< numbers of events
  std::uint16_t pass = 1, passes = 1;
  XY step;  ///< the shift of each pass
  double diameter = 0;
  std::uint8_t tool = 0;
  bool has_diameter = false, has_tool = false;
};

/// What of an execution a snapshot keeps, besides the compensator's state.
struct ExecutionState {
  std::vector<Frame> frames;  ///< innermost last; empty: the program is done
  std::uint64_t blocks = 0;   ///< events executed
  std::uint8_t loaded_tool = 0;
  bool is_in_chain = false;  ///< the last event was a cut that continues into the next
  bool is_metric = false;    ///< the unit reported last
  XY at;                     ///< the programmed point
};

/// Executes stored events as motion of the two axes (README, "Decided here"): Z is the operator's.
class Executor {
 public:
  /// References must outlive it. `start`: where the machine is.
  Executor(const ControlOptions& options, const StoredProgram& program, EventSink& sink,
           const Position& start);

  void begin();
  /// The event itself, or the nearest before it without which a run would cut another contour: a
  /// join beside the edge and a conrad come from both of the events that they connect.
  std::uint16_t first_to_begin_with(std::uint16_t number) const;
  /// One event. False: an alarm was made (see `alarm`), or the program is done (see `is_done`).
  bool step();
  bool is_done() const { return state_.frames.empty(); }
  const Diagnostic& alarm() const { return alarm_; }
  const Origin& origin() const { return origin_; }

  /// Of the event executed last, for the screen; no part of the state.
  struct Shown {
    ToolSide side = ToolSide::Center;
    double tool_radius = 0, feed = 0;  ///< mm, mm per minute
  };
  const Shown& shown() const { return shown_; }

  const ExecutionState& state() const { return state_; }
  const compensation::Compensator& path() const { return path_; }
  EventSink& events() { return path_; }
  Result<void> restore(ExecutionState state, const std::vector<std::byte>& path);

 private:
  ProgramEvent effective(std::uint16_t number) const;
  bool is_connected(const ProgramEvent& event, std::optional<ProgramEvent> next) const;
  std::optional<ProgramEvent> next_in_range() const;
  std::optional<ProgramEvent> previous_in_chain() const;
  bool advance();

  bool execute(const ProgramEvent& event);
  bool execute_cut(const ProgramEvent& event);
  bool begin_repeat(const ProgramEvent& event);
  bool drill_circle(const ProgramEvent& event);
  bool clear_circle(const ProgramEvent& event);
  bool clear_rectangle(const ProgramEvent& event);
  bool run_frame(const ProgramEvent& event);

  void begin_chain(const ProgramEvent& event);
  XY direction_of_chain(ProgramEvent cut) const;
  void end_chain();
  bool join(const Element& first, const Element& second, const ProgramEvent& event,
            std::optional<Element>& corner);
  bool check_arc(const ProgramEvent& event);

  void load_tool(const ProgramEvent& event);
  void wait(StopKind kind);
  void rapid(XY to);
  void cut(const Element& element, double feed);
  void line(XY to, double feed);
  struct Rectangle;
  void run_rectangle(const Rectangle& path, const ProgramEvent& event, bool from_top);
  void run_circle(XY center, double radius, const ProgramEvent& event);
  void tell_units(const ProgramEvent& event);
  bool meets_no_fault();
  bool fail(const DiagnosticRow& fault, std::string_view detail);
  void warn(const DiagnosticRow& fault, std::string_view detail);

  const ControlOptions& options_;
  const StoredProgram& program_;
  compensation::Compensator path_;
  language::LoopGuard loops_;
  ExecutionState state_;
  Position position_;
  Origin origin_;
  Shown shown_;
  Diagnostic alarm_;
};

}  // namespace dripline::interpreter::prototrak
