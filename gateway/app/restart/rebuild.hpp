#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gateway/app/restart/checkpoint_keeper.hpp"
#include "gateway/app/restart/event_tracker.hpp"
#include "gateway/app/restart/restart_plan.hpp"
#include "gateway/app/restart/restart_report.hpp"
#include "gateway/feed/line_feed.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// Brings an interpreter to the place where a run that was cut off continues, by looking through
/// the program from the nearest checkpoint: nothing of that reaches the machine. Meanwhile it
/// compares the state with what was recorded when the program ran. At the end the approach is
/// queued at the machine, and with it what follows of the next block; the machine's time does not
/// pass before cycle start. One thread.
class Rebuild {
 public:
  struct Parts {
    RestartPlan plan;
    interpreter::Interpreter& interpreter;
    EventTracker& tracker;
    feed::ProgramFeed& feed;
    storage::sqlite::Database& database;
    const machine::MotionBackend& machine;
    bool is_lathe = false;
    bool is_tool_axis_manual = false;  ///< Dialect: the operator has raised the tool
    /// The axes are at the program's position + these lengths: before the approach.
    std::function<void(const interpreter::Position&, const machine::ToolLengths&)> begin_lengths;
    /// A block from the place on was interpreted: its modes are in force when it is executed.
    std::function<void()> on_block;
  };
  /// All references must outlive it.
  explicit Rebuild(Parts parts);

  enum class State { Working, NeedsText, Ready, Failed };
  /// A bounded piece of work.
  State work();
  State state() const { return state_; }
  /// Why it failed; nothing was given to the machine then.
  const std::string& fault() const { return fault_; }
  /// Blocks looked through in this phase, for the operator.
  std::uint64_t block() const { return parts_.interpreter.blocks(); }
  const std::string& original_run() const { return parts_.plan.original.run; }

  // When it is ready.
  const RestartReport& report() const { return report_; }
  /// How the interpreter's last step ended: a question or an end is its owner's from here on.
  interpreter::StepState last_step() const { return last_step_; }
  /// Answers given to the interpreter by then.
  const GivenAnswers& answers() const { return used_; }
  /// Those that it was given since the checkpoint.
  std::span<const report::CheckpointStore::Answer> answers_given() const {
    return {answers_.data(), next_answer_};
  }

  static constexpr std::uint64_t kBlocksAtOnce = 4096;

 private:
  enum class Phase { Programs, Tail, Search, Route, Prove, Advance, Open, Preview };
  /// What a look-through has come to.
  enum class Step { Done, More, NeedsText, Ended, Failed };

  State fail_with(std::string fault);
  State find_programs();
  State tail();
  std::string changed_program() const;
  std::string why_other() const;
  State search();
  State prove();
  State advance();
  State open();
  State preview();
  State begin_tail();
  State begin_search();
  State begin_route();
  State route();
  State begin_proof();
  State begin_advance();
  bool load(std::uint64_t block);
  Step run_to(std::uint64_t block, bool may_lack_answers = false);
  bool answer();
  void on_open(interpreter::EventSink& out);
  std::string tilt_fault(const Approach& approach) const;
  std::string thread_fault() const;
  std::string chain_fault() const;
  std::string place_fault() const;
  bool has_approach() const;
  void note_spindle();
  void compare_tools();
  void note_lengths();
  machine::ToolLengths take_lengths();
  interpreter::Position highest(interpreter::Axis up) const;
  bool is_clear(const interpreter::Position& highest, interpreter::Axis up) const;
  void expect_unmoved(const machine::ToolLengths& lengths);
  Result<void> compare_ending() const;

  Parts parts_;
  State state_ = State::Working;
  Phase phase_ = Phase::Programs;
  std::string fault_;
  std::vector<feed::CalledProgram>
      programs_;              ///< by the whole run, as the newest checkpoint has them
  std::size_t place_ = 0;     ///< of the checkpoint in use
  std::uint64_t target_ = 0;  ///< the last block that is not executed again
  std::uint64_t goal_ = 0;    ///< block of a phase's end
  Digest expected_;
  bool lacks_answer_ = false;
  std::vector<report::CheckpointStore::Answer> answers_;
  std::size_t next_answer_ = 0;
  GivenAnswers used_;
  interpreter::StepState last_step_ = interpreter::StepState::Ran;
  std::optional<interpreter::Axis> tool_axis_;
  /// Of the last block that is not executed again.
  std::optional<ReachedHeights::Lengths> lengths_;
  /// Up to the block executed last, for a place before it.
  std::optional<ReachedHeights> reached_;
  /// The tool in the spindle: as the machine has it, else as the program left it.
  struct InSpindle {
    std::optional<int> tool;
    ReachedHeights::Lengths lengths;
    std::optional<interpreter::Axis> axis;
  };
  InSpindle in_spindle_;
  bool changes_tool_ = false;
  std::string approach_fault_;  ///< why no approach was given to the machine
  PassedPath passed_;           ///< of the tool, from some place before the target on
  std::size_t route_steps_ = 0, preview_steps_ = 0;
  RestartReport report_;
};

}  // namespace dripline::gateway
