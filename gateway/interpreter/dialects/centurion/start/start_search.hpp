#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::centurion {

struct Run;

struct StartNotes;

/// Where a run begins when not at its first block: `N120` the first block with this number, `T3`
/// the first with this tool, `L40` the line, `B4096` the first block at or after the byte (a run
/// that was cut off goes on there), `+25` after as many blocks.
struct StartAt {
  enum class Kind : std::uint8_t { Block, Tool, Line, Byte, Count };
  Kind kind = Kind::Block;
  std::uint64_t number = 0;
  std::string text;  ///< as written
};
/// Errors: Syntax.
Result<StartAt> parse_start_at(std::string_view text);

/// Looks for the start through everything the program does before it: nothing of that reaches the
/// machine, but all of it counts (modes, zeros, parameters, tool). At the start the tool, spindle
/// and coolant are shown, M functions and outputs that were not given out are named, and the
/// machine moves from where it stands to where the program is by way of the clearance plane
/// (spec 24.3). A program that has no such place begins at its first block, with a message, and
/// when the operator has agreed. An alarm before anything moves: the block is in a loop, a
/// subroutine or a called program, or the program may come back over it, and `start_pass` does not
/// name which time is meant; it is in a pattern; what comes before it changes parameters that it
/// has read, and `start_memory` does not name which memory is meant (start_notes.hpp).
class StartSearch final : public EventGate {
 public:
  StartSearch(EventSink& out, StartAt start) : EventGate(out), start_(std::move(start)) {}
  /// `state` holds what has to survive a snapshot; it must outlive this.
  void attach(ModalState& state, StartNotes& notes) {
    state_ = &state;
    notes_ = &notes;
  }

  bool is_searching() const { return state_->is_searching; }
  /// Asked before a block is read, and with its tool when it has been.
  bool is_here(const Run& run, std::optional<std::uint32_t> sequence) const;
  bool is_tool(const Run& run, int tool) const;
  /// The program has come to the start. False: an alarm.
  bool arrive(Run& run);
  /// Whether `arrive` needs to know of the blocks that come back (`way_back`, the line of one).
  bool asks_for_way_back(const Run& run) const;
  void note_way_back(std::optional<std::uint64_t> line) { way_back_ = line; }
  /// False: an alarm, since the program comes to the start, but not often enough.
  bool begin_at_first(Run& run);

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;
  // What a program says of itself, and its alarm, are shown all the same.
  void on_program(const ProgramHeader& event) override { out().on_program(event); }
  void on_units(const UnitsChange& event) override { out().on_units(event); }
  void on_blank(const Blank& event) override { out().on_blank(event); }
  void on_alarm(const Alarm& event) override { out().on_alarm(event); }
  void on_miscellaneous(const Miscellaneous& event) override;
  void on_pin(const PinChange& event) override;

 private:
  bool is_open() const override { return !state_->is_searching; }
  template <class Event>
  void move(void (EventSink::*deliver)(const Event&), const Event& event);
  static bool is_same_place(const Run& run);
  bool begin_here(Run& run);
  std::string refusal(const Run& run) const;
  void approach(Run& run, const Point& from, const Point& to);

  const StartAt start_;
  ModalState* state_ = nullptr;
  StartNotes* notes_ = nullptr;
  std::optional<std::uint64_t> way_back_;
};

}  // namespace dripline::interpreter::centurion
