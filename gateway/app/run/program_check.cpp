#include "gateway/app/run/program_check.hpp"

#include <fmt/format.h>

namespace dripline::gateway {

using interpreter::StepState;
using machine::ToolLengths;

void ProgramCheck::Refusals::on_alarm(const interpreter::Alarm& alarm) {
  if (!first && (keeps_all_ || alarm.diagnostic.id.starts_with("MCH"))) first = alarm;
  out().on_alarm(alarm);
}

ProgramCheck::ProgramCheck(Parts parts)
    : parts_(std::move(parts)),
      refusals_(parts_.machine->events(), parts_.is_test),
      filter_(parts_.capabilities, refusals_,
              [this] {
                return machine::CapabilityFilter::Now{interpreter_->modes(),
                                                      interpreter_->origin().block};
              },
              {parts_.dialect.length_shifts_position, parts_.dialect.moves_with_length,
               [this](const ToolLengths& lengths) { parts_.machine->set_lengths(lengths); }}) {
  filter_.begin(parts_.at, parts_.lengths);
}

/// The machine does not say which program its refusal is of: that of the present block, or of a
/// move that came out late, of the one before.
std::optional<interpreter::Alarm> ProgramCheck::found() const {
  const auto& refused = parts_.machine->refusal();
  const auto& first = refusals_.first;
  if (!refused || (first && first->diagnostic.line < refused->line)) return first;
  const bool is_present = interpreter_->origin().line == refused->line;
  interpreter::Alarm alarm{is_present ? interpreter_->origin() : previous_, *refused};
  alarm.origin.line = refused->line;
  return alarm;
}

std::string ProgramCheck::place_of(const interpreter::Origin& origin) const {
  const bool is_called = origin.program != interpreter::kMainProgram && parts_.name_of;
  const std::string name = is_called ? parts_.name_of(origin.program) : std::string();
  return fmt::format("line {}{}{}", origin.line, name.empty() ? "" : " of ", name);
}

ProgramCheck::State ProgramCheck::refuse(const interpreter::Alarm& alarm) {
  interpreter::Origin place = alarm.origin;
  place.line = alarm.diagnostic.line;
  refusal_.origin.line = place.line;
  refusal_.diagnostic = alarm.diagnostic;
  refusal_.diagnostic.text =
      fmt::format("{} ({}, {})", alarm.diagnostic.text, place_of(place),
                  parts_.is_test ? "found by a test run" : "found before the first move");
  return state_ = State::Refused;
}

ProgramCheck::State ProgramCheck::work(SteadyTime now) {
  // A length is looked for after each block: the next one may end it while a motion still waits.
  if (is_over()) return state_;
  if (!began_) began_ = now;
  if (!parts_.is_test && now - *began_ > kLimit) return state_ = State::Passed;
  previous_ = interpreter_->origin();
  const StepState step = interpreter_->step(1);
  (void)filter_.note_block(interpreter_->origin());
  parts_.machine->pass_block();
  if (const auto refusal = found()) return refuse(*refusal);
  switch (step) {
    case StepState::Ran:
      return state_ = State::Working;
    case StepState::NeedsText:
      return state_ = State::NeedsText;
    case StepState::NeedsAnswer:
      if (answer()) return state_ = State::Working;
      // A probe move that the machine cannot make has no answer.
      if (const auto refusal = found()) return refuse(*refusal);
      return state_ = State::Passed;
    case StepState::Ended:
    case StepState::Alarmed:
      break;
  }
  return state_ = State::Passed;
}

namespace {

std::string described(const interpreter::Question& question) {
  using namespace interpreter;
  if (const auto* prompt = std::get_if<PromptQuestion>(&question))
    return fmt::format("asks the operator: {}", prompt->text);
  if (const auto* input = std::get_if<InputQuestion>(&question))
    return fmt::format("asks for input {}", input->pin);
  if (const auto* signal = std::get_if<SignalQuestion>(&question))
    return fmt::format("asks for signal {}", signal->name);
  return std::holds_alternative<ProbeQuestion>(question) ? "probes" : "asks for the time";
}

}  // namespace

/// As a run finds it (RunSession). Only of a test run: other looks end here.
bool ProgramCheck::takes(const interpreter::Probe& probe) {
  if (!parts_.is_test) return true;
  if (parts_.capabilities.probing) return filter_.takes_probe(probe);
  filter_.refuse(probe.origin, "probe");
  return false;
}

/// Nothing: it is not known before the program runs.
std::optional<interpreter::Answer> ProgramCheck::answer_to(const interpreter::Question& question) {
  using namespace interpreter;
  if (std::holds_alternative<PromptQuestion>(question)) {
    if (next_answer_ >= parts_.answers.size()) return std::nullopt;
    return PromptAnswer{parts_.answers[next_answer_++]};
  }
  if (const auto* probe = std::get_if<ProbeQuestion>(&question)) {
    if (!takes(probe->probe)) return std::nullopt;
    auto result = parts_.machine->probe(probe->probe);
    if (!result) return std::nullopt;
    filter_.note_probed(result->at);
    return *std::move(result);
  }
  if (std::holds_alternative<TimeQuestion>(question) && parts_.time) return parts_.time();
  return std::nullopt;
}

bool ProgramCheck::answer() {
  const auto given = answer_to(interpreter_->question());
  if (given && interpreter_->answer(*given)) return true;
  unanswered_ = described(interpreter_->question());
  return false;
}

}  // namespace dripline::gateway
