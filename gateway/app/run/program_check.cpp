#include "gateway/app/run/program_check.hpp"

#include <fmt/format.h>

namespace dripline::gateway {

using interpreter::StepState;

void ProgramCheck::Refusals::on_alarm(const interpreter::Alarm& alarm) {
  if (!first && alarm.diagnostic.id.starts_with("MCH")) first = alarm.diagnostic;
  out().on_alarm(alarm);
}

ProgramCheck::ProgramCheck(Parts parts)
    : parts_(std::move(parts)),
      refusals_(parts_.machine->events()),
      filter_(parts_.capabilities, refusals_, [this] { return interpreter_->modes(); }) {}

std::optional<interpreter::Diagnostic> ProgramCheck::found() const {
  const auto& refused = parts_.machine->refusal();
  if (refused && (!refusals_.first || refused->line <= refusals_.first->line)) return refused;
  return refusals_.first;
}

ProgramCheck::State ProgramCheck::work(SteadyTime now) {
  // A length is looked for after each block: the next one may end it while a motion still waits.
  const std::uint64_t at_once = parts_.capabilities.tool_lengths ? 1024 : 1;
  if (is_over()) return state_;
  if (!began_) began_ = now;
  if (now - *began_ > kLimit) return state_ = State::Passed;
  const StepState step = interpreter_->step(at_once);
  (void)filter_.takes_length(interpreter_->origin());
  if (const auto refusal = found()) {
    refusal_.origin.line = refusal->line;
    refusal_.diagnostic = *refusal;
    refusal_.diagnostic.text =
        fmt::format("{} (line {}, found before the first move)", refusal->text, refusal->line);
    return state_ = State::Refused;
  }
  switch (step) {
    case StepState::Ran:
      return state_ = State::Working;
    case StepState::NeedsText:
      return state_ = State::NeedsText;
    case StepState::NeedsAnswer:
      return state_ = answer() ? State::Working : State::Passed;
    case StepState::Ended:
    case StepState::Alarmed:
      break;
  }
  return state_ = State::Passed;
}

bool ProgramCheck::answer() {
  if (!std::holds_alternative<interpreter::PromptQuestion>(interpreter_->question()) ||
      next_answer_ >= parts_.answers.size())
    return false;
  const interpreter::PromptAnswer given{parts_.answers[next_answer_++]};
  return interpreter_->answer(given).has_value();
}

}  // namespace dripline::gateway
