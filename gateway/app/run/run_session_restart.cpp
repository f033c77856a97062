#include "gateway/app/run/run_session.hpp"

#include <algorithm>
#include <utility>

/// The checkpoints of a run, and its restart.
namespace dripline::gateway {

using interpreter::StepState;

void RunSession::want_checkpoint() {
  if (!checkpoints_ || is_over_ || is_rebuilding()) return;
  wants_checkpoint_ = true;
  if (is_at_boundary_) take_checkpoint();
}

void RunSession::take_checkpoint() {
  wants_checkpoint_ = false;
  if (!checkpoints_) return;
  while (next_early_checkpoint_ <= interpreter_->blocks()) next_early_checkpoint_ *= 2;
  if (next_early_checkpoint_ > kLastEarlyCheckpoint) next_early_checkpoint_ = UINT64_MAX;
  checkpoints_->take({.interpreter = *interpreter_,
                      .delivered = tracker_.delivered(),
                      .feed = feed(),
                      .executed = parts_.recorder.executed(),
                      .machine = parts_.machine.status().position});
}

Result<void> RunSession::begin_rebuild() {
  if (parts_.checkpoints == nullptr)
    return fail(Errc::Unsupported, "a restart: this gateway keeps no checkpoints");
  rebuild_ =
      std::make_unique<Rebuild>(Rebuild::Parts{.plan = *std::exchange(parts_.restart, std::nullopt),
                                               .interpreter = *interpreter_,
                                               .tracker = tracker_,
                                               .feed = feed(),
                                               .database = parts_.checkpoints->database(),
                                               .machine = parts_.machine,
                                               .is_lathe = parts_.is_lathe,
                                               .is_tool_axis_manual = dialect_.is_tool_axis_manual,
                                               .begin_lengths =
                                                   [this](const auto& at, const auto& lengths) {
                                                     parts_.machine.begin_lengths(lengths);
                                                     events_.begin(at, lengths);
                                                   },
                                               .on_block = [this] { note_rebuilt(); }});
  if (rebuild_->state() == Rebuild::State::Failed)
    return fail(Errc::Corrupt, "{}", rebuild_->fault());
  return {};
}

Rebuild::State RunSession::rebuild() {
  const Rebuild::State state = rebuild_->work();
  if (state == Rebuild::State::Ready) end_rebuild();
  return state;
}

/// From the place on the modes belong to their blocks: the length of the block that continues needs
/// those after it, and these may end its compensation.
void RunSession::note_rebuilt() {
  if (!std::exchange(has_rebuilt_, true)) {
    modes_.clear();
    frames_.clear();
    (void)tracker_.take_moves();
    tool_history_.begin(parts_.tool, interpreter_->modes());
  }
  note_modes();
}

/// What the interpreter has come to is the run's from here on.
void RunSession::end_rebuild() {
  is_at_boundary_ = false;
  next_early_checkpoint_ = interpreter_->blocks() + kFirstCheckpoint;
  has_question_ = rebuild_->last_step() == StepState::NeedsAnswer;
  is_over_ =
      rebuild_->last_step() == StepState::Ended || rebuild_->last_step() == StepState::Alarmed;
  keep_inherited(*rebuild_);
  // The clock does not go back before what the skipped blocks have seen.
  for (const auto& given : rebuild_->answers_given()) {
    const auto answer = decode_answer(rebuild_->original_run(), given.number, given.bytes);
    const auto* time = answer ? std::get_if<interpreter::LocalTime>(&*answer) : nullptr;
    if (time == nullptr) continue;
    const std::int64_t gap = interpreter::milliseconds_of(*time) - clock_ms();
    if (gap > 0) clock_ahead_ += static_cast<double>(gap) / 1000;
  }
  next_answer_ = std::min<std::size_t>(setup_.answers.size(), rebuild_->answers().prompts);
  note_rebuilt();
  // What the skipped blocks have changed was executed, though a kill may have kept it from the
  // disk.
  note_memory();
}

/// The run can be restarted itself, before it has a checkpoint of its own.
void RunSession::keep_inherited(const Rebuild& rebuild) {
  report::Outbox& outbox = *parts_.checkpoints;
  const std::string &from = rebuild.original_run(), &run = parts_.run.run;
  const std::uint64_t block = rebuild.report().checkpoint;
  const auto stored = report::CheckpointStore::read(outbox.database(), from, block);
  if (auto kept = read_checkpoint(outbox.database(), from, block); kept && stored) {
    outbox.checkpoints().stage(
        run, {block, stored->executed, stored->time, encode(run, *std::move(kept))});
  }
  for (const auto& given : rebuild.answers_given()) {
    if (auto answer = decode_answer(from, given.number, given.bytes)) {
      outbox.checkpoints().stage_answer(run, given.number,
                                        encode(run, given.number, *std::move(answer)));
    }
  }
  checkpoints_.emplace(parts_.run.run, outbox, parts_.clock, rebuild.answers());
}

}  // namespace dripline::gateway
