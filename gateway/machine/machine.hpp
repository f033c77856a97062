#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/machine/execution_sink.hpp"
#include "gateway/machine/machine_limits.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine {

using Seconds = std::chrono::duration<double>;

enum class MachineState : std::uint8_t {
  Idle,          ///< everything queued is done: before a program, starved, or waiting for an answer
  Running,       ///< moving, dwelling, or about to
  Held,          ///< feed hold asked for: slowing down or standing
  ProgramStop,   ///< M0, an operator stop, or a tool change that waits; `resume` goes on
  OptionalStop,  ///< M1 with its switch on
  SingleBlock,   ///< standing between two blocks
  Completed,     ///< the end of the program was executed
  Alarmed,       ///< `begin` is the only way on
  Aborted,       ///< `begin` is the only way on
  EmergencyStop,  ///< braking or standing; Aborted once it stands and the switch is released
};

enum class MotionKind : std::uint8_t { None, Rapid, Line, Clockwise, Counterclockwise, Thread };

struct MachineStatus {
  MachineState state = MachineState::Idle;
  interpreter::Position position;      ///< actual; the axes follow without a trailing error
  interpreter::Position target;        ///< where the move being made ends; at rest: the position
  double feed_per_minute = 0;          ///< actual speed along the path, mm or degrees
  double spindle_rpm = 0;              ///< actual; negative: counter-clockwise
  interpreter::Origin origin;          ///< of the block being executed, or the last one
  std::uint64_t executed = 0;          ///< Origin::block of the last block executed
  Seconds buffered{0};                 ///< of queued motion and dwells, at 100 % override
  std::size_t queued = 0;              ///< actions waiting
  interpreter::StopKind stopped_at{};  ///< in ProgramStop
  MotionKind motion{};                 ///< of the move being made, or the last one
  bool is_feed_limited = false;        ///< it is made slower than feed and override ask for
  Seconds dwell_left{0};
  std::optional<int> tool, next_tool, tool_offset;  ///< as far as programs have named them
  interpreter::Spindle spindle;                     ///< as programmed
  bool flood = false, mist = false;
};

/// The machine after the interpreter: queues what the program does and executes it in order, in
/// machine time. Pure and deterministic: no thread, socket or clock; time comes in by `advance`.
/// The same events and the same calls at the same machine times give the same execution, however
/// finely time is sliced.
///
/// The owner's loop:
///   while (machine.has_room() && interpreter gives Ran) interpreter.step(1);
///   machine.advance(elapsed * speed);            // or advance_all(budget) for "max"
///   NeedsAnswer, a probe:   begin_probe once, then advance until ExecutionSink::on_probed, answer.
///   NeedsAnswer, others:    advance until drained(), then ask and answer.
///
/// One owner, one thread. Memory is fixed at construction (about 4 MiB). No call allocates, except
/// for alarms and warnings.
class Machine {
 public:
  /// `sink` must outlive the machine. `limits` must pass check(). The workpiece is what probes
  /// meet.
  Machine(const MachineLimits& limits, interpreter::Workpiece workpiece, ExecutionSink& sink);
  ~Machine();
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// A new program, standing at `at`: clears queue, stops, alarm, hold and spindle; keeps the
  /// panel.
  void begin(const interpreter::Position& at);

  const MachineLimits& limits() const;

  // -- what the interpreter does --------------------------------------------------------------
  /// Hand this to the interpreter. Events after an alarm or abort are dropped until `begin`.
  interpreter::EventSink& events();
  /// One more block fits. A block that has more than kBlockReserve actions or kTextReserve bytes of
  /// text beyond this becomes an alarm (MCH0005). Step one block, then ask again.
  bool has_room() const;
  static constexpr std::size_t kQueuedActions = 8192;
  static constexpr std::size_t kBlockReserve = 8192;
  static constexpr std::size_t kQueuedText = 512 * 1024;
  static constexpr std::size_t kTextReserve = 128 * 1024;

  /// Queues the probe move of an open ProbeQuestion. Its end comes as ExecutionSink::on_probed.
  void begin_probe(const interpreter::Probe& probe);
  /// Nothing is queued or moving.
  bool drained() const;
  /// Seconds of queued motion and dwells at 100 % override: what the feed sizes itself by.
  Seconds buffered() const;

  // -- time -----------------------------------------------------------------------------------
  static constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
  /// Executes for `by` (infinite is allowed), at most `max_actions` actions (slowing down for
  /// a hold or an abort goes on beyond them). Returns the machine
  /// time used: less than `by` when it ran out of actions, stands, or used up `max_actions`.
  Seconds advance(Seconds by, std::size_t max_actions = kNoLimit);
  /// As fast as possible: no limit of time.
  Seconds advance_all(std::size_t max_actions = kNoLimit) {
    return advance(Seconds{std::numeric_limits<double>::infinity()}, max_actions);
  }

  // -- the operator ---------------------------------------------------------------------------
  const OperatorPanel& panel() const;
  /// Takes effect at once, along the path with the machine's acceleration. Clamped.
  /// The emergency stop brakes whatever moves, locked or not, turns spindle and coolant off, and
  /// ends the program: on_aborted, when the axes rest and the switch is released. Nothing goes on
  /// while it is pressed, a program that `begin` starts included.
  void set_panel(const OperatorPanel& panel);
  /// Feed hold: slows down along the path and stands. A thread is finished first, and what the
  /// program has locked against it (OverrideInhibit).
  void hold();
  /// Cycle start: ends a hold, a stop or a single-block stop. False when there was none.
  bool resume();
  /// The handwheel was turned, in handwheel mode: lets `program_time` pass, no faster than by
  /// itself. Only forward. Nothing happens in another mode; a tapping cycle is left out, with a
  /// message.
  void turn_handwheel(Seconds program_time);
  /// Slows down along the path, then discards everything: on_aborted, possibly during this call.
  void abort();

  // -- what it does now -----------------------------------------------------------------------
  MachineState state() const;
  /// Axes at rest: with state Held or after `abort` was asked for, tells slowing down from
  /// standing.
  bool is_moving() const;
  MachineStatus status() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

std::string_view to_string(MachineState state);

}  // namespace dripline::machine
