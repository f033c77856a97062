#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/app/execution_recorder.hpp"
#include "gateway/app/memory/control_memory.hpp"
#include "gateway/app/restart/checkpoint_keeper.hpp"
#include "gateway/app/restart/rebuild.hpp"
#include "gateway/app/run/awaited_input.hpp"
#include "gateway/app/run/program_check.hpp"
#include "gateway/app/run/tool_in_position.hpp"
#include "gateway/feed/line_feed.hpp"
#include "gateway/interpreter/core/live_values.hpp"
#include "gateway/interpreter/registry.hpp"
#include "gateway/interpreter/stages/dry_run.hpp"
#include "gateway/machine/capability_filter.hpp"

namespace dripline::gateway {

/// One run: its text, its interpreter and the questions between interpreter, machine and operator.
/// The owner fills the machine's queue through it, and lets the machine's time pass by itself.
/// One thread.
class RunSession {
 public:
  struct Parts {
    report::ActiveRun run;
    std::unique_ptr<feed::ProgramFeed> feed;  ///< where its text comes from
    machine::MotionBackend& machine;
    ExecutionRecorder& recorder;
    const Clock& clock;
    ControlMemory& memory;
    /// The program gets the control's memory of the last beginning of its revision; a difference
    /// takes effect when the first block is executed.
    bool begins_with_former_memory = false;
    report::Outbox* checkpoints = nullptr;  ///< where they are kept; null: none are, nor a restart
    std::optional<RestartPlan> restart = {};
    std::unique_ptr<machine::MotionCheck> check = {};  ///< null: the program is not looked through
    bool is_lathe = false;
    bool is_mdi = false;   ///< keyed in at the control
    bool is_test = false;  ///< `check` is all that is done; nothing reaches the machine
    const interpreter::Snapshot* modes =
        nullptr;  ///< in which the control is; null: as at power on
    /// How the position relates to the axes; nothing: these are at the start of the program.
    std::optional<ToolInPosition> tool = {};
    interpreter::Position at = {};  ///< of the program at its beginning, which
    ToolLengths lengths = {};       ///< leaves these out (MotionCapabilities::adds_lengths)
    /// In a dry run of a machine that knows none: the events' own feeds change.
    std::optional<interpreter::PanelTables::DryRun> dry_run = {};
  };
  /// Errors: those of Dialect::make. The machine is unchanged then.
  static Result<std::unique_ptr<RunSession>> make(Parts parts, const interpreter::Dialect& dialect,
                                                  const interpreter::Setup& setup);

  /// Interprets up to `max_blocks` while the machine has room and no answer is awaited. Returns the
  /// number of blocks.
  std::size_t fill(std::size_t max_blocks);

  enum class Waits { ForNothing, ForText, ForMachine, ForOperator };
  /// The reason why the last `fill` ended.
  Waits waits() const { return waits_; }
  /// The operator's open question; only while ForOperator.
  std::string prompt() const;
  /// Errors: Busy (nothing was asked), Syntax (not an answer to this).
  Result<void> answer(const std::string& text);

  const report::ActiveRun& run() const { return parts_.run; }
  bool is_mdi() const { return parts_.is_mdi; }
  bool is_test() const { return parts_.is_test; }
  bool keeps_checkpoints() const { return checkpoints_.has_value(); }
  /// After the run was completed: the control as its end leaves it, for an MDI. The session is of
  /// no other use then. Errors: those of Interpreter::begin_next_text.
  Result<interpreter::Snapshot> take_modes();
  /// Those modes fit another place of the axes too, interpreter::MovedAxes.
  bool keeps_zero_when_moved() const;
  /// After the run was completed: Interpreter::next_part.
  std::uint32_t next_part() { return interpreter_->next_part(); }
  feed::ProgramFeed& feed() { return *parts_.feed; }
  const feed::ProgramFeed& feed() const { return *parts_.feed; }
  /// Blocks interpreted.
  std::uint64_t accepted() const {
    return parts_.is_test ? check_->block() : interpreter_->blocks();
  }
  /// The modes of `block`.
  const interpreter::ActiveModes& modes_at(std::uint64_t block) const;
  /// The program's coordinate frame at that block; nothing when the control does not report it.
  const std::optional<interpreter::CoordinateFrame>& frame_at(std::uint64_t block) const;
  /// How the position relates to the axes when the machine rests in `block`, which was cut off;
  /// nothing: all blocks were executed.
  ToolInPosition tool_at_end(const std::optional<std::uint64_t>& block) const {
    return tool_history_.at_end(block);
  }
  /// Passes the changes of the blocks up to `executed` to the control's memory.
  void keep_memory(std::uint64_t executed);
  /// The hash of the path when `block` ended.
  std::uint64_t path_at(std::uint64_t block) const { return tracker_.path_at(block); }
  /// Millimeters of path up to its end; nothing: not known any more.
  std::optional<double> length_at(std::uint64_t block) const { return tracker_.length_at(block); }
  /// Of moves and dwells of the executed blocks, by the machine's time; as exact as a slice of it.
  double motion_seconds() const { return executed_seconds_; }
  /// So much has passed since the last call: what a machine moves that passes time by itself.
  void note_real_time(SteadyTime::duration elapsed);

  std::uint64_t blocks_since_checkpoint() const {
    return checkpoints_ ? accepted() - checkpoints_->last_block() : 0;
  }
  /// Stages a checkpoint now, or at the end of the block in hand.
  void want_checkpoint();
  /// The look through the program before its first move; null: there is none any more.
  ProgramCheck* check() { return check_.get(); }
  const ProgramCheck* check() const { return check_.get(); }
  void end_check() { check_.reset(); }
  /// A restart that has not come to its place yet: `rebuild` continues it, `fill` does nothing.
  bool is_rebuilding() const { return rebuild_ && rebuild_->state() != Rebuild::State::Ready; }
  Rebuild::State rebuild();
  /// The restart; null: the run is none.
  const Rebuild* restart() const { return rebuild_.get(); }

  /// For the blocks that are not interpreted yet. Returns the block that was interpreted last;
  /// nothing: there is none after it.
  std::optional<std::uint64_t> set_block_skip(std::uint16_t levels);
  /// Under which it runs, for a restart of it.
  void keep_conditions(Conditions conditions) { conditions_ = std::move(conditions); }
  /// A switch that skips blocks was changed: "block_skip on". `last`: as `set_block_skip` gave it;
  /// `block_skip`: how it is now.
  void note_skip_change(const std::string& change, std::uint64_t last, bool block_skip);

  /// The machine has used up so much of its time, which passes `factor` times as fast as the
  /// computer's (nullopt: as fast as possible). The clock that the program sees follows it.
  void pass_machine_time(double seconds, std::optional<double> factor);
  /// Sizes the feed by the rate at which the program's bytes are used up, as far as it is known.
  void size_feed(std::optional<double> speed_factor);

 private:
  RunSession(Parts parts, const interpreter::Dialect& dialect, const interpreter::Setup& setup);
  using Make = std::function<Result<std::unique_ptr<interpreter::Interpreter>>(
      const interpreter::Setup&, interpreter::EventSink& events)>;
  Result<void> give_memory(const Make& make, const interpreter::Setup& setup);
  /// True: the interpreter can continue.
  bool resolve_question();
  bool is_checkpoint_due() const {
    return wants_checkpoint_ || interpreter_->blocks() >= next_early_checkpoint_ ||
           (checkpoints_ && checkpoints_->lacks_programs(feed()));
  }
  void take_checkpoint();
  Result<void> begin_check(const Make& make, const interpreter::Setup& setup);
  Result<void> begin_rebuild();
  void end_rebuild();
  void note_rebuilt();
  void keep_inherited(const Rebuild& rebuild);
  bool resolve(const interpreter::ProbeQuestion& question);
  bool resolve(const interpreter::PromptQuestion& question);
  bool resolve(const interpreter::InputQuestion& question);
  bool resolve(const interpreter::TimeQuestion& question);
  bool resolve(const interpreter::SignalQuestion& question);
  bool give(const interpreter::Answer& answer);
  bool machine_rests() const;
  /// What the program's clock shows: milliseconds since 1970.
  std::int64_t clock_ms() const;
  void note_modes();
  void note_memory();
  void begin_live();
  void note_live();
  void note_changes(std::uint64_t block);
  void drop_modes();

  Parts parts_;
  interpreter::Setup setup_;  ///< its answers are given here, not by the interpreter
  std::size_t next_answer_ = 0;
  double motion_seconds_ = 0, executed_seconds_ = 0;  ///< so far, and up to block `timed_`
  std::uint64_t timed_ = 0;
  double clock_ahead_ = 0;     ///< of the computer's clock, seconds: machine time that was faster
  std::int64_t begun_ms_ = 0;  ///< since 1970, by the computer's clock
  const interpreter::Dialect& dialect_;
  machine::CapabilityFilter events_;  ///< from the tracker to the machine
  std::optional<interpreter::DryRun> dry_run_;
  EventTracker tracker_;  ///< from the interpreter
  std::optional<CheckpointKeeper> checkpoints_;
  Conditions conditions_;
  bool wants_checkpoint_ = false, is_at_boundary_ = true;
  /// A short program is read to its end at once: its first checkpoints come at doubled distances.
  std::uint64_t next_early_checkpoint_ = kFirstCheckpoint;
  static constexpr std::uint64_t kFirstCheckpoint = 4, kLastEarlyCheckpoint = 65'536;
  std::unique_ptr<interpreter::Interpreter> interpreter_;
  interpreter::RetainedMemory* retained_ =
      nullptr;  ///< of the interpreter; null: its control keeps nothing
  struct Change {
    std::uint64_t block = 0;
    std::size_t cell = 0;
    double value = 0;
  };
  std::deque<Change> changes_;                 ///< of blocks that are not executed yet
  std::vector<double> cells_, known_;          ///< as read last, and as it was before
  interpreter::LiveValues* live_ = nullptr;    ///< of the interpreter; null: its control shows none
  std::vector<double> live_now_, live_known_;  ///< as read last, and as it was before
  std::deque<Change> live_changes_;            ///< of blocks that are not executed yet
  Waits waits_ = Waits::ForNothing;
  struct Modes {
    std::uint64_t block = 0;  ///< the first that runs under them
    interpreter::ActiveModes modes;
  };
  /// From the executing block on, one for each change; as many as the machine queues blocks.
  std::deque<Modes> modes_;
  struct Frame {
    std::uint64_t block = 0;
    std::optional<interpreter::CoordinateFrame> frame;
  };
  std::deque<Frame> frames_;  ///< likewise
  ToolHistory tool_history_;
  std::unique_ptr<ProgramCheck> check_;
  std::unique_ptr<Rebuild> rebuild_;
  bool has_rebuilt_ = false;  ///< to the place: modes are noted from there on
  bool is_over_ = false, has_question_ = false, is_probing_ = false;
  std::optional<AwaitedInput> input_wait_;  ///< while the program waits for one
};

/// The run that the parts of a gateway work on, and how the last one ended.
struct CurrentRun {
  std::string machine;
  std::unique_ptr<RunSession> session;  ///< null: no run
  bool is_ending = false;               ///< its last records are staged, not yet on disk
  bool was_emergency_stopped = false;   ///< it ends when the switch is released
  dds::Execution last_execution = dds::Execution::Ready;
  std::string last_message;
  /// Of the last program of this process, at its end; nothing: none has run, or its control reports
  /// no coordinates.
  std::optional<interpreter::CoordinateFrame> frame_left = {};
  /// What the screen shows by without a program: that one, or what the control's memory and the
  /// server's setup give it since; nothing: not known.
  std::optional<interpreter::CoordinateFrame> frame_at_rest = {};
  bool was_shifted = false;  ///< at the same moment: ActiveModes::is_shifted
  ToolInPosition tool = {};  ///< between two runs

  /// Commands and motion apply to it.
  bool is_active() const { return session && !is_ending; }
  /// For the log: "machine=M run=R program=P".
  std::string label() const {
    if (!session) return fmt::format("machine={}", machine);
    return fmt::format("machine={} run={} program={}", machine, session->run().run,
                       session->run().program);
  }
};

}  // namespace dripline::gateway
