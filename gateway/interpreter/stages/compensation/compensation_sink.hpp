#pragma once

#include <optional>

#include "gateway/interpreter/stages/compensation/policy.hpp"

namespace dripline::interpreter::compensation {

/// A command to compensation as data, which a stage in front of it keeps in its place among the
/// events.
struct Command {
  enum class Kind : std::uint8_t {
    TurnOn,          ///< from the next move on, with `cutter`
    TurnOff,         ///< the next move is the cancel move
    Cancel,          ///< off at once; the next move goes straight to its programmed end
    SuppressOutput,  ///< moves lead the program, the tool does not carry them out
    ResumeOutput,
  };
  Kind kind = Kind::TurnOff;
  Cutter cutter{};
  std::optional<StartUp> start_up{};  ///< of TurnOn, in place of the policy's
};

/// A sink that takes commands to compensation: the compensator, and a stage in front of it.
class CompensationSink : public EventSink {
 public:
  virtual void on_compensation(const Command& command) = 0;
  /// As on_block_end, of a block that `Policy::blocks_without_motion` leaves out: it has nothing
  /// for the machine (a macro statement, a call, a return).
  virtual void on_uncounted_block_end(const Origin& event) = 0;

  /// The next move in the plane is the start-up move. While on: the elements from here on are
  /// offset by the new cutter; for another plane compensation is canceled and started again. On the
  /// same side a corner between two radii is a corner as any other; between two sides the first
  /// element ends and the second begins on its own normal, connected by a straight piece.
  /// `start_up` replaces the policy's for this one time.
  void turn_on(const Cutter& cutter, std::optional<StartUp> start_up = {}) {
    on_compensation({Command::Kind::TurnOn, cutter, start_up});
  }
  /// The next move in the plane is the cancel move; until then the tool keeps its place in the
  /// plane.
  void turn_off() { on_compensation({Command::Kind::TurnOff}); }
  /// Ends the waiting move on its own normal and is off: the next move in the plane goes straight
  /// from where the tool is to its programmed end, whatever it is. What interrupts compensation
  /// cancels it, then switches it on again.
  void cancel() { on_compensation({Command::Kind::Cancel}); }
  /// From here on, or no longer: moves lead the program and decide corners, but the tool does not
  /// carry them out. The next real move starts from where the tool is.
  void suppress_output(bool is_suppressed) {
    on_compensation({is_suppressed ? Command::Kind::SuppressOutput : Command::Kind::ResumeOutput});
  }
};

}  // namespace dripline::interpreter::compensation
