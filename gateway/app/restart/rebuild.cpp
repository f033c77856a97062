#include "gateway/app/restart/rebuild.hpp"

#include <algorithm>
#include <utility>

namespace dripline::gateway {

using interpreter::StepState;

namespace {

/// Ends of blocks may come this much later than the blocks, where a contour is looked ahead.
constexpr std::uint64_t kLookAhead = 1024;
/// Blocks after the place that are interpreted for the length of the next move.
constexpr std::size_t kPreviewSteps = 64;

}  // namespace

Rebuild::Rebuild(Parts parts) : parts_(std::move(parts)) {
  parts_.tracker.close({}, 0, nullptr);
  const auto& checkpoints = parts_.plan.checkpoints;
  const auto target = parts_.plan.known_target();
  place_ = parts_.plan.nearest(target.value_or(parts_.plan.ending.executed.executed + 1));
  const auto checkpoint =
      read_checkpoint(parts_.database, parts_.plan.original.run, checkpoints.back().block);
  if (!checkpoint) {
    fail_with(checkpoint.error().what);
    return;
  }
  programs_ = checkpoint->programs;
  report_.original = parts_.plan.original;
  report_.at = parts_.plan.at;
  report_.cut_off_at = parts_.plan.ending.executed.executed;
  report_.on_record = parts_.plan.on_record;
  const machine::MachineStatus status = parts_.machine.status();
  report_.machine = status.axes();
  report_.stopped_at = parts_.plan.ending.stopped_at;
  in_spindle_.tool = status.tool;
  in_spindle_.lengths = {.of_axes = status.lengths, .of_tool = status.lengths};
}

Rebuild::State Rebuild::fail_with(std::string fault) {
  fault_ = std::move(fault);
  parts_.tracker.close({}, 0, nullptr);
  return state_ = State::Failed;
}

Rebuild::State Rebuild::work() {
  if (state_ == State::Ready || state_ == State::Failed) return state_;
  switch (phase_) {
    case Phase::Programs:
      return state_ = find_programs();
    case Phase::Tail:
      return state_ = tail();
    case Phase::Search:
      return state_ = search();
    case Phase::Route:
      return state_ = route();
    case Phase::Prove:
      return state_ = prove();
    case Phase::Advance:
      return state_ = advance();
    case Phase::Open:
      return state_ = open();
    case Phase::Preview:
      return state_ = preview();
  }
  return state_;
}

/// Programs are known by their indices in a snapshot, so they are asked for in the same order.
Rebuild::State Rebuild::find_programs() {
  for (const auto& opened : parts_.feed.called_programs()) {
    if (std::ranges::find(programs_, opened.name, &feed::CalledProgram::name) == programs_.end())
      return fail_with(fmt::format("program {} was opened before its restart", opened.name));
  }
  bool is_known = true;
  for (const auto& called : programs_) {
    is_known &= parts_.feed.find(called.name).state != interpreter::ProgramLookup::State::NotYet;
  }
  if (!is_known) return State::NeedsText;
  if (const std::string changed = changed_program(); !changed.empty())
    return fail_with(fmt::format("changed since run {}: {}", parts_.plan.original.run, changed));
  const auto target = parts_.plan.known_target();
  target_ = target.value_or(0);
  const bool is_earlier = !target || *target < parts_.plan.ending.executed.executed;
  return is_earlier ? begin_tail() : begin_route();
}

/// What the path back to an earlier place goes over: clamps, and what else the program went over
/// since. The newest checkpoint has it of all before.
Rebuild::State Rebuild::begin_tail() {
  if (!load(parts_.plan.checkpoints.back().block)) return State::Failed;
  goal_ = parts_.plan.ending.executed.executed;
  phase_ = Phase::Tail;
  return State::Working;
}

Rebuild::State Rebuild::tail() {
  const Step step = run_to(goal_, true);
  if (step == Step::Failed) return State::Failed;
  if (step == Step::NeedsText) return State::NeedsText;
  if (step == Step::More) return State::Working;
  reached_ = parts_.tracker.delivered().heights;
  note_spindle();
  return parts_.plan.known_target() ? begin_route() : begin_search();
}

/// Why the look-through comes to something else.
std::string Rebuild::why_other() const {
  const std::string skipped = parts_.plan.skip_text();
  return skipped.empty() ? "text, setup, a switch that skips blocks, or software have changed"
                         : skipped;
}

/// A program that the run called, and that is another one now; empty: none. A server that does not
/// state contents leaves them to the comparison of states and paths.
std::string Rebuild::changed_program() const {
  const auto present = parts_.feed.called_programs();
  for (const auto& then : programs_) {
    const auto now = std::ranges::find(present, then.name, &feed::CalledProgram::name);
    if (now == present.end()) return fmt::format("program {} cannot be found", then.name);
    if (now->is_missing && !then.content.empty())
      return fmt::format("program {} is not in the library any more", then.name);
    if (then.is_missing && !now->is_missing)
      return fmt::format("program {} was not in the library, it is", then.name);
    const bool is_comparable = !then.content.empty() && !now->content.empty();
    if (is_comparable && then.content != now->content) {
      return fmt::format("the content of called program {} was {}, it is {}", then.name,
                         then.content.substr(0, 12), now->content.substr(0, 12));
    }
  }
  return {};
}

/// Restores the checkpoint of the plan at this block, with the gate closed.
bool Rebuild::load(std::uint64_t block) {
  const std::string& run = parts_.plan.original.run;
  const auto checkpoint = read_checkpoint(parts_.database, run, block);
  if (!checkpoint) {
    fail_with(checkpoint.error().what);
    return false;
  }
  if (auto restored = parts_.interpreter.restore(checkpoint->snapshot); !restored) {
    fail_with(fmt::format("checkpoint at block {}: {}", block, restored.error().what));
    return false;
  }
  auto answers = report::CheckpointStore::answers(parts_.database, run, checkpoint->answers);
  if (!answers) {
    fail_with(answers.error().what);
    return false;
  }
  answers_ = *std::move(answers);
  next_answer_ = 0;
  used_ = {checkpoint->answers, checkpoint->prompts};
  lacks_answer_ = false;
  last_step_ = StepState::Ran;
  parts_.tracker.close(checkpoint->delivered, 0, nullptr);
  return true;
}

bool Rebuild::answer() {
  if (next_answer_ >= answers_.size() || answers_[next_answer_].number != used_.all + 1)
    return false;
  const auto given =
      decode_answer(parts_.plan.original.run, used_.all + 1, answers_[next_answer_].bytes);
  if (!given || !parts_.interpreter.answer(*given)) return false;
  ++next_answer_;
  ++used_.all;
  used_.prompts += std::holds_alternative<interpreter::PromptAnswer>(*given) ? 1 : 0;
  return true;
}

/// Interprets up to that block, or as much as is due in one piece.
Rebuild::Step Rebuild::run_to(std::uint64_t block, bool may_lack_answers) {
  const std::uint64_t now = parts_.interpreter.blocks();
  if (now >= block) return Step::Done;
  last_step_ = parts_.interpreter.step(std::min(block - now, kBlocksAtOnce));
  switch (last_step_) {
    case StepState::Ran:
      return parts_.interpreter.blocks() >= block ? Step::Done : Step::More;
    case StepState::NeedsText:
      return Step::NeedsText;
    case StepState::NeedsAnswer:
      if (answer()) return Step::More;
      if (may_lack_answers) return Step::Ended;
      fail_with(
          fmt::format("the program asks something in block {}, and the answer of run {} is "
                      "not on record",
                      parts_.interpreter.blocks() + 1, parts_.plan.original.run));
      return Step::Failed;
    case StepState::Ended:
    case StepState::Alarmed:
      break;
  }
  if (may_lack_answers || parts_.interpreter.blocks() >= block) return Step::Ended;
  const auto& alarm = parts_.tracker.alarm();
  const std::string skipped = parts_.plan.skip_text();
  fail_with(fmt::format("the program ends in block {} before block {}{}{}{}{}",
                        parts_.interpreter.blocks(), block, alarm ? ": " : "",
                        alarm ? alarm->text : "", skipped.empty() ? "" : "; ", skipped));
  return Step::Failed;
}

Rebuild::State Rebuild::begin_search() {
  using Kind = RestartPlace::Kind;
  const auto& checkpoints = parts_.plan.checkpoints;
  if (!load(checkpoints[place_].block)) return State::Failed;
  const RestartPlace& at = parts_.plan.at;
  EventTracker::Wanted wanted;
  wanted.until = parts_.plan.ending.executed.executed + 1;
  if (at.kind == Kind::Line) wanted.line = at.number;
  if (at.kind == Kind::Sequence) wanted.sequence = static_cast<std::int64_t>(at.number);
  if (at.kind == Kind::Tool)
    wanted.tool = static_cast<int>(std::min<std::uint64_t>(at.number, INT32_MAX));
  // Up to the next checkpoint, which was searched from before.
  goal_ = wanted.until;
  if (place_ + 1 < checkpoints.size()) goal_ = std::min(goal_, checkpoints[place_ + 1].block);
  goal_ += kLookAhead;
  parts_.tracker.search(wanted);
  phase_ = Phase::Search;
  return State::Working;
}

Rebuild::State Rebuild::search() {
  const Step step = run_to(goal_, true);
  if (step == Step::Failed) return State::Failed;
  if (step == Step::NeedsText) return State::NeedsText;
  if (step == Step::More) return State::Working;
  if (parts_.tracker.found() > 0) {
    target_ = parts_.tracker.found() - 1;
    return begin_route();
  }
  if (place_ == 0) {
    return fail_with(fmt::format("{} is not among the {} blocks that run {} has executed",
                                 parts_.plan.at.text, parts_.plan.ending.executed.executed,
                                 parts_.plan.original.run));
  }
  --place_;
  return begin_search();
}

/// Between the checkpoint before the place and the one after it; where there is none after it,
/// between the two before it.
Rebuild::State Rebuild::begin_proof() {
  const auto& checkpoints = parts_.plan.checkpoints;
  place_ = parts_.plan.nearest(target_);
  std::size_t from = place_, to = place_ + 1;
  if (to >= checkpoints.size()) {
    if (place_ == 0) return begin_advance();
    from = place_ - 1;
    to = place_;
  }
  const auto goal =
      read_checkpoint(parts_.database, parts_.plan.original.run, checkpoints[to].block);
  if (!goal) return fail_with(goal.error().what);
  goal_ = goal->block;
  expected_ = goal->snapshot.digest();
  if (!load(checkpoints[from].block)) return State::Failed;
  phase_ = Phase::Prove;
  return State::Working;
}

Rebuild::State Rebuild::prove() {
  const Step step = run_to(goal_);
  if (step == Step::Failed) return State::Failed;
  if (step == Step::NeedsText) return State::NeedsText;
  if (step == Step::More) return State::Working;
  if (last_step_ != StepState::Ran || parts_.interpreter.snapshot().digest() != expected_) {
    return fail_with(
        fmt::format("the state rebuilt at block {} is not the one that run {} had there: {}", goal_,
                    parts_.plan.original.run, why_other()));
  }
  report_.state_equal_at = goal_;
  report_.state_digest = expected_;
  return begin_advance();
}

Rebuild::State Rebuild::begin_advance() {
  const std::uint64_t block = parts_.plan.checkpoints[place_].block;
  if (!load(block)) return State::Failed;
  report_.checkpoint = block;
  tool_axis_ = parts_.interpreter.modes().tool_axis;
  parts_.tracker.close(parts_.tracker.delivered(), target_,
                       [this](interpreter::EventSink& out) { on_open(out); });
  // The checkpoint itself may be at the place.
  if (parts_.tracker.delivered().ended.block >= target_) parts_.tracker.open_now();
  phase_ = Phase::Advance;
  return State::Working;
}

/// One block short of the place: its own block may open the gate, and the modes are those before
/// it. A control that executes several blocks in one step may open it earlier.
Rebuild::State Rebuild::advance() {
  const Step step = parts_.tracker.is_closed() && target_ > 0 ? run_to(target_ - 1) : Step::Done;
  if (step == Step::Failed) return State::Failed;
  if (step == Step::NeedsText) return State::NeedsText;
  if (parts_.tracker.is_closed()) tool_axis_ = parts_.interpreter.modes().tool_axis;
  if (step == Step::More && parts_.tracker.is_closed()) return State::Working;
  phase_ = Phase::Open;
  return State::Working;
}

/// Block by block over the place, until the end of its block has come through the look-ahead.
Rebuild::State Rebuild::open() {
  if (parts_.tracker.is_closed()) {
    const bool is_short = parts_.interpreter.blocks() < target_;
    const Step step = run_to(parts_.interpreter.blocks() + 1, !is_short);
    if (step == Step::Failed) return State::Failed;
    if (step == Step::NeedsText) return State::NeedsText;
    if (parts_.interpreter.blocks() == target_) {
      note_lengths();
      report_.modes = parts_.interpreter.modes();
      report_.frame = parts_.interpreter.frame();
    }
    if (parts_.interpreter.blocks() >= target_) parts_.on_block();
    if (step == Step::Ended && parts_.tracker.is_closed()) {
      return fail_with(
          fmt::format("the path after block {} depends on an answer of run {} that is "
                      "not on record, or the program ends there",
                      target_, parts_.plan.original.run));
    }
    if (parts_.tracker.is_closed()) return State::Working;
  } else {
    report_.modes = parts_.interpreter.modes();
    report_.frame = parts_.interpreter.frame();
    parts_.on_block();
  }
  if (const auto equal = compare_ending(); !equal) return fail_with(equal.error().what);
  if (!approach_fault_.empty()) return fail_with(approach_fault_);
  const auto& executed = parts_.plan.ending.executed;
  report_.is_path_equal = report_.after.block == executed.executed && executed.path != 0;
  phase_ = Phase::Preview;
  return State::Working;
}

/// The hash of everything that was given to the machine, and the place, as the journal had them
/// when the block was executed.
Result<void> Rebuild::compare_ending() const {
  const report::Progress& then = parts_.plan.ending.executed;
  if (report_.after.block != then.executed || then.executed == 0) return {};
  const bool is_same_place = report_.after.line == then.line &&
                             report_.after.sequence == then.sequence &&
                             report_.after.offset == then.offset;
  const bool is_same_path = then.path == 0 || then.path == report_.delivered.path;
  if (is_same_place && is_same_path) return {};
  return fail(Errc::Conflict, "what leads to block {} is not what run {} had executed: {}",
              then.executed, parts_.plan.original.run, why_other());
}

/// A little further, for the length of the block that continues.
Rebuild::State Rebuild::preview() {
  const bool is_over = last_step_ == StepState::Ended || last_step_ == StepState::Alarmed ||
                       (last_step_ == StepState::NeedsAnswer && lacks_answer_);
  const bool is_enough = parts_.tracker.measured().has_ended || !parts_.machine.has_room() ||
                         ++preview_steps_ > kPreviewSteps;
  if (!is_over && !is_enough) {
    last_step_ = parts_.interpreter.step(1);
    if (last_step_ == StepState::NeedsText) return State::NeedsText;
    if (last_step_ == StepState::NeedsAnswer) lacks_answer_ = true;
    parts_.on_block();
    return State::Working;
  }
  report_.next = parts_.tracker.measured();
  if (report_.next.block == 0) report_.next.block = report_.after.block + 1;
  return State::Ready;
}

}  // namespace dripline::gateway
