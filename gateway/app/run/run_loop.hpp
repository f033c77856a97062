#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gateway/app/command_log.hpp"
#include "gateway/app/memory/control_memory.hpp"
#include "gateway/app/options.hpp"
#include "gateway/app/panel/consent.hpp"
#include "gateway/app/run/run_session.hpp"
#include "gateway/app/run/start_argument.hpp"

namespace dripline::gateway {

/// What a start brings besides the program.
struct StartOrigin {
  std::string command;      ///< its command, to be answered; empty: none
  std::string setup;        ///< what the server knows of tools, offsets and variables, TOML
  StartArgument from = {};  ///< where it begins; without a place at the beginning
  std::string argument;     ///< the same, as it was given
};

/// A run from its beginning to its end: steps the interpreter, lets the machine move, puts reports
/// on disk, and ends the run when the machine has ended. One thread.
class RunLoop {
 public:
  struct Parts {
    const GatewayOptions& options;
    const interpreter::Dialect& dialect;
    const interpreter::Setup& setup;
    const std::string& setup_digest;  ///< SHA-256 of the setup's text; empty: none
    bool keeps_checkpoints = true;    ///< programs from a line cannot be read again
    const Clock& clock;
    report::Outbox& outbox;
    report::RunJournal& journal;
    report::MotionJournal* motion_journal = nullptr;  ///< null: the machine is never ahead
    machine::MotionBackend& machine;
    ExecutionRecorder& recorder;
    ControlMemory& memory;
    CommandLog& commands;
    Consent& consent;
    CurrentRun& run;
    std::function<void(const interpreter::Setup&)> on_begin;  ///< with the setup that is used
    std::function<void()> on_over;                            ///< the session is gone
    std::function<void()> serve_panel;  ///< again and again while recover waits
  };
  /// All references must outlive it.
  explicit RunLoop(Parts parts) : parts_(std::move(parts)) {}

  /// Before anything else: ends the run that a former process was executing as interrupted at the
  /// block it executed last: waits until a device that had motion in hand shows where it rests, if
  /// it does within kRestWait. Errors: those of the outbox.
  Result<void> recover();

  /// Errors: Busy (the emergency stop), those of the setup, of the machine and of the outbox; no
  /// run has begun then.
  Result<void> begin(const report::ActiveRun& run, std::unique_ptr<feed::ProgramFeed> feed,
                     const StartOrigin& given);
  /// Does what is due for the run, for at most about `kSlice`.
  void step(SteadyTime now);
  /// Begins a run that waits for cycle start at the machine.
  void cycle_start();
  /// A restart looks through its program; nothing moves yet.
  bool is_rebuilding() const {
    return parts_.run.is_active() && parts_.run.session->is_rebuilding();
  }
  /// The program is looked through before its first move.
  bool is_checking() const { return parts_.run.is_active() && parts_.run.session->check(); }
  /// Nothing of the run reaches the machine.
  bool is_testing() const { return parts_.run.is_active() && parts_.run.session->is_test(); }
  /// By the operator. A run's end comes when the machine rests.
  void abort();
  /// A look-through has work to do, and does not wait for text.
  bool is_looking_through() const;
  /// A hold is the operator's from here on: records on disk again do not end it.
  void keep_hold() { is_held_by_fault_ = false; }
  /// The gateway itself moves an axis by a jog, from now until `end_jog`.
  void begin_jog();
  /// `is_certain`: where it is now is known.
  void end_jog(bool is_certain);
  /// What the operator has to know of how the run has begun; empty: nothing.
  const std::string& notice() const { return notice_; }
  /// The process ends: nothing more of the run reaches the machine, which comes to rest, and the
  /// run ends as interrupted then.
  void begin_interrupt(const std::string& reason);
  /// Nothing of the run is left that the machine has to come to rest with.
  bool may_be_interrupted() const;
  /// Ends the run, if any, as interrupted. Errors: those of the outbox; then the next start does
  /// it.
  Result<void> interrupt(const std::string& reason);

  /// The machine moves, or is about to.
  bool is_moving() const;
  /// The next step waits for the machine alone, a probe's answer for instance.
  bool waits_for_machine() const;

  static constexpr std::chrono::milliseconds kSlice{8};  ///< of work between two looks at the inbox
  static constexpr std::chrono::seconds kRestWait{10};
  static constexpr std::chrono::milliseconds kCommitRetry{500};
  static constexpr std::chrono::milliseconds kLongestStep{100};  ///< real time never jumps by more

 private:
  Result<interpreter::Setup> setup_of(const StartOrigin& origin,
                                      const std::optional<RestartPlan>& restart) const;
  Conditions conditions_of(const StartOrigin& origin) const;
  Result<std::unique_ptr<machine::MotionCheck>> check_of(const interpreter::Position& axes,
                                                         bool tests, bool is_restart) const;
  bool is_test(const StartOrigin& origin) const {
    return origin.from.is_test || parts_.machine.panel().test_run;
  }
  void begin_test(std::unique_ptr<RunSession> session);
  void end_test(const ProgramCheck& check);
  std::optional<interpreter::PanelTables::DryRun> dry_run() const;
  StartOrigin read_on(const report::ActiveRun& run, StartOrigin origin) const;
  void keep_tape();
  void state_tape();
  const interpreter::Snapshot* modes_for(const StartOrigin& origin);
  void take_modes();
  void note_left();
  void note_beginning(const StartOrigin& origin, bool has_modes);
  void note_tape(const StartOrigin& origin, bool has_modes);
  std::string notice_of_mdi() const;
  std::string notice_of_modes(const StartOrigin& origin, bool has_modes) const;
  void begin_modes(const StartOrigin& origin, bool has_modes);
  void keep_modes_of_part();
  Result<std::optional<RestartPlan>> plan_of(const report::ActiveRun& run,
                                             const StartOrigin& origin) const;
  Result<void> keep_staged();
  Result<void> stage_start(const report::ActiveRun& run, const StartOrigin& origin,
                           Conditions conditions, RunSession& session);
  void run_slice(SteadyTime now);
  bool run_round(double& machine_seconds, SteadyTime deadline);
  bool wait_for_beginning(SteadyTime now);
  bool wait_out_fault(SteadyTime now);
  void commit_reports();
  void keep_state(SteadyTime now);
  void checkpoint_at_stop(SteadyTime now);
  void rebuild(SteadyTime now);
  void show_restart();
  void check_program(SteadyTime now);
  void report_memory();
  void stage_ending(dds::RunOutcome outcome);
  InHand in_hand(const std::string& run, std::uint64_t executed) const;
  void resolve_interrupted(const std::string& run, RunEnding& ending);
  void resolve_at_rest();
  void check_end();
  bool is_interrupted() const;
  std::string overdue_reason() const;
  void commit_state();
  void end(dds::RunOutcome outcome, const std::string& reason);
  void try_to_finish(SteadyTime now);

  Parts parts_;
  bool is_held_by_fault_ = false;
  std::string why_interrupted_;         ///< empty: the process does not end
  bool is_aborted_by_command_ = false;  ///< this run, before that
  /// What the control has in force after its last text, for an MDI or a program of a tape that
  /// follows.
  struct Modes {
    interpreter::Snapshot snapshot;
    interpreter::Position at;
    interpreter::SpindleState spindle{};
    std::string setup, memory;  ///< digests
    bool keeps_zero = false;    ///< RunSession::keeps_zero_when_moved
    bool is_of_part = false;    ///< with which a program of the tape began, and was cut off
    bool is_keyed_in = false;   ///< left by an MDI that began with those of power on
  };
  std::optional<Modes> modes_;
  std::optional<Modes> modes_of_part_;  ///< those that the program of the tape has begun with
  bool is_jogging_ = false;             ///< from where `modes_` were
  bool is_keyed_in_ = false;            ///< of this run: Modes::is_keyed_in
  std::string
      last_run_;  ///< that may have moved the machine; empty: none since the gateway was started
  struct Resting {
    std::string run;
    RunEnding ending;
    SteadyTime next_commit;
  };
  std::optional<Resting> resting_;  ///< an ending that lacks the place where the axes rest
  std::string why_no_modes_ = "nothing has run since the gateway was started";
  std::string notice_;
  std::string setup_given_;  ///< digest of the server's setup of this run
  struct Locked {
    interpreter::Position at;
    ToolInPosition tool;
  };
  std::optional<Locked> locked_at_;  ///< of this run: the axes end there
  /// A test run begins with a copy, so that neither its setup nor its program changes the memory.
  std::optional<ControlMemory> tested_memory_;
  SteadyTime last_step_{}, next_commit_{}, next_sync_{}, next_checkpoint_{};
  machine::MachineState last_state_{};
  std::uint64_t look_rounds_ = 0;
  bool has_dropped_checkpoint_ = false;  ///< of this run, for the log
  dds::RunOutcome ended_as_{};           ///< while its end is not on disk
};

inline constexpr std::string_view kIsRebuilding =
    "the restart still looks through the program: cycle start when it reports what it will do";
inline constexpr std::string_view kIsChecking =
    "the program is still looked through for what the machine cannot do: press cycle start again";
inline constexpr std::string_view kTestOfRestart =
    "a restart is not tested: it finds its place by running (switch test_run off)";
inline constexpr std::string_view kNoHoldOfTest =
    "a test run moves nothing, so there is nothing to hold; an abort ends it";
inline constexpr std::string_view kEmergencyStop =
    "the emergency stop is pressed: release it first (switch emergency_stop off)";

}  // namespace dripline::gateway
