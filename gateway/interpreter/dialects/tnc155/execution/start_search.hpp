#pragma once

#include <cstdint>

#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

/// A start in the middle of a program (GOTO before the start). On the control a run that was
/// terminated leaves tool, transformations, CC and cycle in force (manual: program run,
/// termination); here they are rebuilt by executing the program up to the block without any output
/// to the machine. A state that cannot be rebuilt is refused before anything moves.

namespace dripline::interpreter::tnc155 {

/// The last stage before the sink, closed while the start is looked for.
class StartGate final : public EventGate {
 public:
  explicit StartGate(EventSink& out) : EventGate(out) {}
  /// `start` is where the state is kept; it must outlive this.
  void attach(StartState& start) { start_ = &start; }

  // The program's header and its alarm are delivered in any case.
  void on_program(const ProgramHeader& event) override { out().on_program(event); }
  void on_units(const UnitsChange& event) override { out().on_units(event); }
  void on_blank(const Blank& event) override { out().on_blank(event); }
  void on_alarm(const Alarm& event) override { out().on_alarm(event); }
  void on_tool(const ToolChange& event) override;
  void on_miscellaneous(const Miscellaneous& event) override;

 private:
  bool is_open() const override { return !start_->is_searching; }
  StartState* start_ = nullptr;
};

/// The block that the start names is read and not executed: the machine's state is announced, the
/// operator is asked, and the run continues from the position of the machine. `returning`: the
/// block that leads back over this one, -1 without one. False: the run has failed.
bool begin_at_block(Run& run, std::int32_t number, std::int32_t returning);

/// Compensation, or a corner that the next move decides.
bool is_contour_open(const State& state);
/// After each block of the search: where the contour in force began.
void note_contour_start(Run& run, std::int32_t number);

/// After note_use (run.hpp) of what a computation of the search reads: the one that it sets. False:
/// a block before has read the value that the last run has left, and it would be another one now.
bool note_result(Run& run, const Block& block);
/// The same of a Q word of a cycle, which gives its parameter a value; also without a search.
bool note_definition(Run& run, const Block& block, std::int32_t parameter);
/// FN 0 to FN 8 of the search.
bool note_computation(Run& run, const Block& block);

/// Of the first positioning block of a run: it must be absolute, and after GOTO name two
/// coordinates; all others must be where the program has them, and so must all where it is an arc.
/// False: the run has failed.
bool check_start(Run& run, const Block& block, const Target& target, bool is_arc = false);
/// Where the program has the tool at the start: what continues the first move (CT) depends on it.
PlaneVector expected_in_plane(const State& state);

/// Motion other than by a positioning block needs one first. `what`: "a cycle call".
bool refuse_before_positioning(Run& run, std::string_view what);

}  // namespace dripline::interpreter::tnc155
