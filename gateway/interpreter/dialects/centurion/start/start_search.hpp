#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"
#include "gateway/interpreter/stages/dry_run.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::centurion {

struct Run;

struct StartNotes;

/// Where a run begins, if not at its first block: `N120` the first block with this number, `T3` the
/// first with this tool, `L40` the first block in the text from the line on that has content,
/// `B4096` that from the byte on (where an interrupted run resumes), `+25` after this number of
/// blocks, as they are executed.
struct StartAt {
  enum class Kind : std::uint8_t { Block, Tool, Line, Byte, Count };
  Kind kind = Kind::Block;
  std::uint64_t number = 0;
  std::string text;  ///< as written
};
/// Errors: Syntax.
Result<StartAt> parse_start_at(std::string_view text);

/// Searches for the start by interpreting everything before it: nothing of that reaches the
/// machine, but all of it takes effect (modes, zeroes, parameters, tool). At the start, tool,
/// spindle and coolant are reported, M functions and outputs that were withheld are named, and the
/// machine moves to the program's position over the clearance plane (manual: RUN and VERIFY,
/// search). A program that has no such place begins at its first block, with a message, after the
/// operator has agreed. It is an alarm, before anything moves, when the block is in a loop, a
/// subroutine or a called program, or the program may jump back over it, and `start_pass` does not
/// name the pass; when it is in a pattern, in nose compensation or after a corner that it ends; and
/// when the part before it changes parameters that it has read, and `start_memory` does not name
/// the memory (start_notes.hpp); when the program never comes to the block of a line or a byte; and
/// where X would have to cross beside the part, as no clearance (P140) is set.
class StartSearch final : public EventGate {
 public:
  StartSearch(EventSink& out, StartAt start) : EventGate(out), start_(std::move(start)) {}
  /// `state` holds what has to survive a snapshot; it must outlive this.
  void attach(ModalState& state, StartNotes& notes) {
    state_ = &state;
    notes_ = &notes;
  }

  bool is_searching() const { return state_->is_searching; }
  /// The block of a line or a byte has been found there, whether the program comes to it or not.
  bool is_in_text() const { return place_.has_value(); }
  /// Whether the block of a line or a byte has still to be found in the text (find_block).
  bool needs_place() const;
  BlockPlace wanted_place() const { return {start_.kind == StartAt::Kind::Line, start_.number}; }
  /// The byte it begins at; none: the text ends before it.
  void note_place(std::optional<std::uint64_t> offset) {
    place_ = offset;
    is_place_known_ = true;
  }
  /// Asked before a block is read, and again with its tool after that.
  bool is_here(const Run& run, std::optional<std::uint32_t> sequence) const;
  bool is_tool(const Run& run, int tool) const;
  /// The program has reached the start. False: an alarm.
  bool arrive(Run& run);
  /// Whether `arrive` needs to know the line of a block that jumps back over the start.
  bool needs_jump_back(const Run& run) const;
  void note_jump_back(std::optional<std::uint64_t> line) { jump_back_ = line; }
  /// False: an alarm, because the program reaches the start, but fewer times than `start_pass`.
  bool begin_at_first(Run& run);

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;
  // The header of a program and its alarm pass even now.
  void on_program(const ProgramHeader& event) override { out().on_program(event); }
  void on_units(const UnitsChange& event) override { out().on_units(event); }
  void on_blank(const Blank& event) override { out().on_blank(event); }
  void on_alarm(const Alarm& event) override { out().on_alarm(event); }
  void on_miscellaneous(const Miscellaneous& event) override;
  void on_pin(const PinChange& event) override;

 private:
  /// From the machine's place to the program's, machine millimeters.
  struct Approach {
    Point from, to;
    std::optional<double> clearance;  ///< of Z
  };
  bool is_open() const override { return !state_->is_searching; }
  template <class Event>
  void move(void (EventSink::*deliver)(const Event&), const Event& event);
  static bool is_same_place(const Run& run);
  bool begin_here(Run& run);
  std::string refusal(const Run& run) const;
  void show_tool(Run& run, const Point& to);
  Approach approach_of(const Run& run) const;
  bool may_cross(Run& run, const Approach& approach) const;
  void make_approach(Run& run, const Approach& approach);

  const StartAt start_;
  ModalState* state_ = nullptr;
  StartNotes* notes_ = nullptr;
  std::optional<std::uint64_t> jump_back_;
  std::optional<std::uint64_t> place_;  ///< of a line or a byte: where its block begins
  bool is_place_known_ = false;
};

}  // namespace dripline::interpreter::centurion
