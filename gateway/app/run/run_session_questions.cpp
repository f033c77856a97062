#include "gateway/app/run/run_session.hpp"

/// What the program asks: of the machine, of its operator, of the clock.
namespace dripline::gateway {

bool RunSession::resolve_question() {
  const interpreter::Question question = interpreter_->question();
  return std::visit([this](const auto& asked) { return resolve(asked); }, question);
}

bool RunSession::resolve(const interpreter::ProbeQuestion& question) {
  waits_ = Waits::ForMachine;
  if (!parts_.machine.capabilities().probing) {
    events_.refuse(question.probe.origin, "probe");
    is_over_ = true;
    return false;
  }
  if (!is_probing_ && !events_.takes_probe(question.probe)) {
    is_over_ = true;
    return false;
  }
  if (!is_probing_) {
    parts_.machine.begin_probe(question.probe);
    is_probing_ = true;
  }
  const auto probed = parts_.recorder.take_probed();
  if (!probed || !probed->result) return false;
  is_probing_ = false;
  events_.note_probed(probed->result->at);
  return give(*probed->result);
}

bool RunSession::resolve(const interpreter::PromptQuestion&) {
  if (!machine_rests()) return false;
  if (next_answer_ < setup_.answers.size()) {
    return give(interpreter::PromptAnswer{setup_.answers[next_answer_++]});
  }
  waits_ = Waits::ForOperator;
  return false;
}

bool RunSession::resolve(const interpreter::InputQuestion& question) {
  if (!machine_rests()) return false;
  const bool state = parts_.machine.input(question.pin);
  if (question.wait == interpreter::InputWait::Nothing) return give(state);
  if (!input_wait_) input_wait_.emplace(question, parts_.clock.steady_now());
  const auto fulfilled = input_wait_->look(state, parts_.clock.steady_now());
  if (!fulfilled || !give(*fulfilled)) return false;
  input_wait_.reset();
  return true;
}

bool RunSession::resolve(const interpreter::TimeQuestion&) {
  return machine_rests() && give(interpreter::local_time_at(clock_ms()));
}

bool RunSession::resolve(const interpreter::SignalQuestion& question) {
  if (!machine_rests()) return false;
  const auto value = parts_.machine.signal(question.name);
  return value && give(*value);
}

bool RunSession::machine_rests() const {
  return parts_.machine.drained() && parts_.machine.state() == machine::MachineState::Idle;
}

/// An answer the interpreter cannot use leaves the question open; the next one in line, or the
/// operator, is asked.
bool RunSession::give(const interpreter::Answer& answer) {
  const auto taken = interpreter_->answer(answer);
  if (!taken) return false;
  has_question_ = false;
  if (checkpoints_) checkpoints_->note_answer(answer);
  return true;
}

std::string RunSession::prompt() const {
  if (waits_ != Waits::ForOperator) return {};
  const auto* question = std::get_if<interpreter::PromptQuestion>(&interpreter_->question());
  return question == nullptr ? std::string() : question->text;
}

Result<void> RunSession::answer(const std::string& text) {
  if (waits_ != Waits::ForOperator) return fail(Errc::Busy, "the program has asked nothing");
  const interpreter::PromptAnswer given{text};
  const auto taken = interpreter_->answer(given);
  if (!taken) return taken;
  has_question_ = false;
  if (checkpoints_) checkpoints_->note_answer(given);
  return {};
}

}  // namespace dripline::gateway
