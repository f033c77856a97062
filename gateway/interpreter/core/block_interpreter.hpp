#pragma once

#include <utility>

#include "gateway/interpreter/core/interpreter.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::interpreter {

/// Part of the state of every run.
enum class RunPhase : std::uint8_t { Running, Ended, Alarmed };

/// Why a function of a control gave false.
enum class Pause : std::uint8_t { None, ForAlarm, ForQuestion, ForText };

/// The members of every run that `BlockInterpreter` works on.
struct BlockRun {
  /// Returns false. `detail` follows the control's text: which value, which limit.
  [[gnu::cold]] bool fail(const DiagnosticRow& row, std::uint32_t column,
                          std::string_view detail = {}) {
    pause = Pause::ForAlarm;
    alarm = diagnostic(row, detail, origin.line, column);
    return false;
  }

  Origin origin;      ///< of the block in hand, or the last one
  Question question;  ///< the open one, or the last one
  Diagnostic alarm;
  Pause pause = Pause::None;
  std::uint32_t frame_changes = 0;  ///< how often the coordinate frame became another
};

/// How far a control has come with its next block.
enum class [[nodiscard]] BlockOutcome : std::uint8_t{
    Finished,     ///< a block, which takes one from the budget of the step
    NoBlock,      ///< text that is no block, or work between two blocks
    MoreFollows,  ///< so much work that the owner has its turn before the rest
    NeedsText,    ///< the source gave NotYet
    Paused,       ///< for the reason in `BlockRun::pause`
};

/// The skeleton of a control that executes its text block by block: phases, budget, questions,
/// alarms and snapshots. `Control`, which derives from it, has `run_`, a `BlockRun` with `state`
/// (`phase`, `blocks`) and `events()`, and
/// - `run_block()`: does the next thing and reports a `BlockOutcome`;
/// - `drop_text()`: the owner may have used the source since the last step;
/// - `is_at_boundary()`: no block has been begun;
/// - `take_answer(answer)`: keeps one that fits the question;
/// - `before_alarm()`: moves that wait are dropped or made;
/// - `after_restore()`: `run_` has another state;
/// and in its namespace `take_snapshot(run)` and `restore_snapshot(run, snapshot)`. The control is
/// known at compile time, so that a block costs no virtual call.
template <class Control>
class BlockInterpreter : public Interpreter {
 public:
  StepState step(std::uint64_t max_blocks) final {
    if (control().run_.state.phase == RunPhase::Alarmed) return StepState::Alarmed;
    if (control().run_.state.phase == RunPhase::Ended) return StepState::Ended;
    if (is_asking_) return StepState::NeedsAnswer;
    control().drop_text();
    for (std::uint64_t left = max_blocks; left > 0;) {
      switch (control().run_block()) {
        case BlockOutcome::Finished:
          --left;
          break;
        case BlockOutcome::NoBlock:
          break;
        case BlockOutcome::MoreFollows:
          return StepState::Ran;
        case BlockOutcome::NeedsText:
          return StepState::NeedsText;
        case BlockOutcome::Paused:
          return paused();
      }
      if (control().run_.state.phase == RunPhase::Ended) [[unlikely]]
        return StepState::Ended;
    }
    return StepState::Ran;
  }

  const Question& question() const final { return control().run_.question; }
  Result<void> answer(const Answer& answer) final {
    if (!is_asking_) return fail(Errc::Syntax, "no question is open");
    if (!fits(question(), answer)) return fail(Errc::Syntax, "an answer to another question");
    if (auto taken = control().take_answer(answer); !taken) return taken;
    is_asking_ = false;
    return {};
  }

  std::uint64_t blocks() const final { return control().run_.state.blocks; }
  const Origin& origin() const final { return control().run_.origin; }

  Snapshot snapshot() const final {
    invariant(control().is_at_boundary(), "a snapshot is taken between blocks");
    return take_snapshot(control().run_);
  }
  Result<void> restore(const Snapshot& snapshot) final {
    auto& run = control().run_;
    if (auto restored = restore_snapshot(run, snapshot); !restored) return restored;
    run.pause = Pause::None;
    ++run.frame_changes;
    is_asking_ = false;
    control().after_restore();
    return {};
  }

 protected:
  /// The origin of the events from here on: the block that begins at `place`, without a number yet.
  template <class Place>
  void place_origin(const Place& place) {
    Origin& origin = control().run_.origin;
    origin.block = blocks() + 1;
    origin.offset = place.offset;
    origin.line = place.line;
    origin.sequence = Origin::kNone;
    origin.program = place.program;
  }

  void before_alarm() {}

 private:
  StepState paused() {
    auto& run = control().run_;
    const Pause why = std::exchange(run.pause, Pause::None);
    if (why == Pause::ForText) return StepState::NeedsText;
    if (why == Pause::ForQuestion) {
      is_asking_ = true;
      return StepState::NeedsAnswer;
    }
    control().before_alarm();
    run.events().on_alarm({run.origin, run.alarm});
    run.state.phase = RunPhase::Alarmed;
    return StepState::Alarmed;
  }

  Control& control() { return static_cast<Control&>(*this); }
  const Control& control() const { return static_cast<const Control&>(*this); }

  bool is_asking_ = false;
};

}  // namespace dripline::interpreter
