#include "gateway/app/run/program_check.hpp"

#include <fmt/format.h>

namespace dripline::gateway {

using interpreter::StepState;
using machine::ToolLengths;

void ProgramCheck::Refusals::on_alarm(const interpreter::Alarm& alarm) {
  if (!first && alarm.diagnostic.id.starts_with("MCH")) first = alarm.diagnostic;
  out().on_alarm(alarm);
}

ProgramCheck::ProgramCheck(Parts parts)
    : parts_(std::move(parts)),
      refusals_(parts_.machine->events()),
      filter_(parts_.capabilities, refusals_,
              [this] {
                return machine::CapabilityFilter::Now{interpreter_->modes(),
                                                      interpreter_->origin().block};
              },
              {parts_.dialect.length_shifts_position, parts_.dialect.moves_with_length,
               [this](const ToolLengths& lengths) { parts_.machine->set_lengths(lengths); }}) {
  filter_.begin(parts_.at, parts_.lengths);
}

std::optional<interpreter::Diagnostic> ProgramCheck::found() const {
  const auto& refused = parts_.machine->refusal();
  if (refused && (!refusals_.first || refused->line <= refusals_.first->line)) return refused;
  return refusals_.first;
}

ProgramCheck::State ProgramCheck::work(SteadyTime now) {
  // A length is looked for after each block: the next one may end it while a motion still waits.
  if (is_over()) return state_;
  if (!began_) began_ = now;
  if (now - *began_ > kLimit) return state_ = State::Passed;
  const StepState step = interpreter_->step(1);
  (void)filter_.note_block(interpreter_->origin());
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
