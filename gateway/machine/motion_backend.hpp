#pragma once

#include <bitset>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/machine/execution_sink.hpp"
#include "gateway/machine/machine_status.hpp"
#include "gateway/machine/operator_panel.hpp"
#include "gateway/machine/position_trust.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine {

/// A device that reads programs by itself too: those of `control` that name no unit in `units`.
struct ProgramReader {
  std::string_view control;
  interpreter::Units units = interpreter::Units::Millimeter;
  std::string startup_code = {};  ///< `[control] startup_code` by which it has other modes
  std::string settings = {};      ///< that make it read programs otherwise, for people
};

/// What a back end can do. A program that asks for more gets an alarm in place of the event
/// (capability_filter.hpp); an operator's command that asks for more is refused.
struct MotionCapabilities {
  std::bitset<interpreter::kAxisCount> axes;
  bool arcs = false;
  bool threads = false;           ///< feed synchronized to the spindle
  bool spindle_feedback = false;  ///< feed and dwell per revolution
  bool probing = false;           ///< on straight lines at a feed
  bool arc_probing = false;
  bool rapid_probing = false;
  bool feed_override = false, rapid_override = false, spindle_override = false;
  bool single_block = false;
  bool dry_run = false;    ///< obeys OperatorPanel::dry_run at once
  bool handwheel = false;  ///< moves the program forward by `turn_handwheel`
  bool simulated_time =
      false;                  ///< `poll` lets machine time pass: another speed than 1x is possible
  bool places_axes = false;   ///< `begin` puts the axes where it is asked to
  bool tool_lengths = false;  ///< a tool's length in force is taken into account
  /// ... by axes of its own, which go to the program's position + length (`set_lengths`). False:
  /// the axes are those of the program, and a length has no place.
  bool adds_lengths = false;
  bool jog = false;  ///< moves an axis without a program (`MotionBackend::jog`)
  std::optional<ProgramReader> reader = {};
};

/// One axis moves by a distance, without a program; a click of a handwheel is one.
struct Jog {
  interpreter::Axis axis = interpreter::Axis::X;
  double distance = 0;                      ///< mm or degrees; X of a lathe as a radius
  double feed_per_minute = 0;               ///< no override changes it
  interpreter::LengthDisplay display = {};  ///< of a refusal
};

/// What a back end without signals answers.
inline interpreter::SignalValue no_signals() {
  return {std::nullopt, "this machine has no HAL; one that LinuxCNC moves has (linuxcnc:INI)"};
}

/// Takes a program's events as a back end does, and executes nothing.
class MotionCheck {
 public:
  virtual ~MotionCheck() = default;
  virtual interpreter::EventSink& events() = 0;
  /// As MotionBackend's.
  virtual void set_lengths(const ToolLengths&) {}
  /// After each block.
  virtual void pass_block() {}
  /// What the probe move of an open ProbeQuestion finds; nothing: it is not known beforehand.
  virtual std::optional<interpreter::ProbeResult> probe(const interpreter::Probe&) {
    return std::nullopt;
  }
  /// Of the moves and dwells so far, at 100 % override; nothing: it is not known.
  virtual std::optional<Seconds> motion_time() const { return std::nullopt; }
  /// The first thing that the machine cannot do, with its line.
  virtual const std::optional<interpreter::Diagnostic>& refusal() const = 0;
};

/// What moves the axes: takes what the program does, executes it in order and reports what was
/// executed. The gateway knows this interface only.
///
/// The owner's loop:
///   while (backend.has_room() && the interpreter returns Ran) interpreter.step(1);
///   backend.poll(elapsed);
///   NeedsAnswer, a probe:   begin_probe once, then poll until ExecutionSink::on_probed; answer.
///   NeedsAnswer, others:    poll until drained(), then ask and answer.
///
/// One owner, one thread. A back end with threads of its own queues what they report, and delivers
/// it inside of `poll`. The *executed* counter is ExecutionSink::on_block_executed: a device's
/// acknowledgment of a text line is not enough for it, the motion must have ended.
class MotionBackend {
 public:
  virtual ~MotionBackend() = default;

  virtual const MotionCapabilities& capabilities() const = 0;

  /// Whether a program can begin with the axes at `at`, lengths of tools included. Errors: Conflict
  /// (they are elsewhere, and this back end cannot place them), Busy (an alarm, no link).
  virtual Result<void> check_begin(const interpreter::Position& at) const = 0;
  /// For a look through a program that begins at `at`, before its first move. Null: what the
  /// machine cannot do is found at its place only.
  virtual std::unique_ptr<MotionCheck> make_check(const interpreter::Position&) const {
    return nullptr;
  }
  /// For a test run of a program that begins at `at`: nothing moves. Null: the machine knows no
  /// limits beforehand.
  virtual std::unique_ptr<MotionCheck> make_test(const interpreter::Position& at) const {
    return make_check(at);
  }
  /// A new program that begins at `at`: clears queue, stops, alarm, hold and spindle; keeps the
  /// panel.
  virtual void begin(const interpreter::Position& at) = 0;
  /// After `begin`: the position of the program leaves these lengths out.
  virtual void begin_lengths(const ToolLengths&) {}

  /// The same for a text that the control continues with (MDI): spindle and coolant run on, and the
  /// tool is shown.
  virtual void begin_next(const interpreter::Position& at) { begin(at); }

  // -- what the interpreter does --------------------------------------------------------------
  /// Hand this to the interpreter. Events after an alarm or abort are dropped until `begin`.
  virtual interpreter::EventSink& events() = 0;
  /// The positions of the events and probes that follow leave these lengths out. Between two
  /// moves; with `adds_lengths` only.
  virtual void set_lengths(const ToolLengths&) {}
  /// One more block fits: the limit of the read-ahead. Step one block, then ask again.
  virtual bool has_room() const = 0;
  /// Queues the probe move of an open ProbeQuestion. Its end comes as ExecutionSink::on_probed.
  virtual void begin_probe(const interpreter::Probe& probe) = 0;
  /// The state of an input pin, to answer an InputQuestion.
  virtual bool input(int pin) const = 0;
  /// The inputs that the device reports, as they are now; empty: it reports none.
  virtual std::vector<std::pair<std::string, bool>> inputs() const { return {}; }
  /// A signal of the machine's own, to answer a SignalQuestion; nothing: it is asked for, and comes
  /// later.
  virtual std::optional<interpreter::SignalValue> signal(const std::string& /*name*/) {
    return no_signals();
  }
  /// Nothing is queued or moving.
  virtual bool drained() const = 0;
  /// Queued motion and dwells at 100 % override: what the feed sizes itself by.
  virtual Seconds buffered() const = 0;

  // -- time -----------------------------------------------------------------------------------
  static constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
  /// Executes, or takes what the device has executed, since the last call. `elapsed`: how much
  /// machine time passes (infinite is allowed), ignored without `simulated_time`. At most
  /// `max_actions` actions begin; slowing down continues beyond them. Returns the machine time
  /// used.
  virtual Seconds poll(Seconds elapsed, std::size_t max_actions) = 0;

  // -- the operator ---------------------------------------------------------------------------
  virtual const OperatorPanel& panel() const = 0;
  /// Takes effect at once. Values are clamped. The emergency stop brakes every move, stops spindle
  /// and coolant, and ends the program: on_aborted at standstill with the switch released. Nothing
  /// starts or continues while it is pressed, a program of `begin` included.
  virtual void set_panel(const OperatorPanel& panel) = 0;
  /// Feed hold: slows down along the path to standstill. A thread is finished first, and what the
  /// program has locked against a hold (OverrideInhibit).
  virtual void hold() = 0;
  /// Cycle start: ends a hold, a stop or a single-block stop. False when there was none.
  virtual bool resume() = 0;
  /// A safety door was opened since the hold began: only the operator at the machine ends it.
  virtual bool needs_operator() const { return false; }
  /// Ends a hold that a fault of the owner's own was the reason of. False: this one is left to the
  /// operator, a safety door was opened meanwhile.
  virtual bool continue_unattended() { return resume(); }
  /// The handwheel was turned, in handwheel mode: lets `program_time` pass, no faster than by
  /// itself and only forward.
  virtual void turn_handwheel(Seconds program_time) = 0;
  /// Slows down along the path, then discards everything: on_aborted, possibly during this call.
  virtual void abort() = 0;
  /// Moves the axes to their reference points; only the operator at the machine asks for it, while
  /// no program runs. Returns at once. Errors: Unsupported (nothing to home), Busy.
  virtual Result<void> home() {
    return fail(Errc::Unsupported, "this machine has nothing to home");
  }
  /// Stops what `home` has begun; the position is lost then. False: nothing is homed.
  virtual bool stop_homing() { return false; }
  /// Takes the position of a locked machine for right, without homing. Errors: as for home.
  virtual Result<void> unlock() {
    return fail(Errc::Unsupported, "this machine has nothing to unlock");
  }

  /// Begins a jog of a machine that `check_begin` finds ready where its axes are, while no program
  /// runs. It ends by itself, with its link or the gateway lost too. Errors: Unsupported, Busy,
  /// LimitExceeded (the end is beyond the travel); nothing moves then.
  virtual Result<void> jog(const Jog&) {
    return fail(Errc::Unsupported, "this machine moves by programs alone: it is not jogged");
  }
  /// Until the axes rest again and their position is known, or the jog is lost. `poll` lets it
  /// move where time is simulated.
  virtual bool is_jogging() const { return false; }
  /// Slows down along the path and drops the rest; so do `hold`, `abort`, the emergency stop and a
  /// feed override of 0 on the panel.
  virtual void stop_jog() {}
  /// What has ended the last jog before its end besides a stop; empty: nothing has.
  virtual std::string jog_fault() const { return {}; }

  // -- what it does now -----------------------------------------------------------------------
  /// Why no program can begin or continue, for the operator; empty: no reason of the machine's.
  virtual std::string notice() const { return {}; }
  virtual MachineState state() const = 0;
  /// Distinguishes slowing down from standstill in Held, or after `abort`.
  virtual bool is_moving() const = 0;
  virtual MachineStatus status() const = 0;
  /// Where the axes rest, after a motion that was cut off too; nothing: they move, or have lost
  /// their position.
  virtual std::optional<GivenAction::Point> rests_at() const { return std::nullopt; }
  virtual PositionTrust position_trust() const { return PositionTrust::Kept; }
};

/// Makes a back end that reports to `sink`, which outlives it. A device was opened before.
using MotionFactory = std::function<std::unique_ptr<MotionBackend>(ExecutionSink& sink)>;

}  // namespace dripline::machine
