#include "gateway/app/gateway.hpp"

/// The part of the gateway that tells how it is.
namespace dripline::gateway {

using dds::Execution;
using machine::MachineState;

namespace {

Execution execution_of(MachineState state) {
  switch (state) {
    case MachineState::Idle:
    case MachineState::Running:
      return Execution::Active;
    case MachineState::Held:
      return Execution::FeedHold;
    case MachineState::ProgramStop:
      return Execution::ProgramStopped;
    case MachineState::OptionalStop:
      return Execution::OptionalStop;
    case MachineState::SingleBlock:
      return Execution::Interrupted;
    case MachineState::Completed:
      return Execution::ProgramCompleted;
    case MachineState::Alarmed:
    case MachineState::Aborted:
      return Execution::Stopped;
  }
  return Execution::Stopped;
}

}  // namespace

dds::Status Gateway::status() const {
  dds::Status status;
  status.machine = parts_.options.machine;
  status.session = parts_.session;
  status.time = parts_.clock.now();
  const machine::MachineStatus now = machine_.status();
  for (std::size_t i = 0; i < status.position.size(); ++i) {
    const auto axis = static_cast<interpreter::Axis>(i);
    status.position[i] = now.position.raw(axis);
    if (machine_.limits().axis(axis)) status.axes |= static_cast<std::uint16_t>(1U << i);
  }
  status.feed_mm_per_min = now.feed_per_minute;
  status.spindle_rpm = now.spindle_rpm;
  status.feed_override = machine_.panel().feed_override;
  status.rapid_override = machine_.panel().rapid_override;
  status.spindle_override = machine_.panel().spindle_override;
  status.single_block = machine_.panel().single_block;
  status.outbox =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(outbox_.unacknowledged(), UINT32_MAX));
  if (session_) {
    status.run = session_->run().run;
    status.program = session_->run().program;
    status.total_bytes = session_->run().size;
    status.sent = session_->feed().sent();
    status.accepted = session_->accepted();
    status.executed = recorder_.executed().executed;
    status.offset = now.origin.offset;
    status.line = now.origin.line;
    status.sequence = now.origin.sequence;
    status.buffered_seconds = now.buffered.count();
  }
  fill_execution(status);
  return status;
}

void Gateway::fill_execution(dds::Status& status) const {
  std::string message = last_message_;
  status.execution = session_ && !is_ending_ ? execution_of_run(message) : last_execution_;
  if (!recorder_.trouble().empty()) {
    status.execution = Execution::Waiting;
    message = fmt::format("reports can not be kept: {}", recorder_.trouble());
  } else if (message.empty()) {
    message = line_trouble_;
  }
  status.message = valid_text(message, kMaxReason);
}

Execution Gateway::execution_of_run(std::string& message) const {
  const MachineState state = machine_.state();
  message.clear();
  if (state == MachineState::Idle) {
    if (session_->waits() == RunSession::Waits::ForOperator) {
      message = "asks: " + session_->prompt();
      return Execution::Waiting;
    }
    if (session_->waits() == RunSession::Waits::ForText) {
      if (parts_.line != nullptr) {
        message = line_trouble_.empty() ? "waiting for text from the line" : line_trouble_;
        return Execution::Waiting;
      }
      message = is_connected_ ? "waiting for program text" : "waiting for program text: no server";
      return Execution::Waiting;
    }
  }
  if (state == MachineState::ProgramStop || state == MachineState::OptionalStop)
    message = recorder_.notice();
  if (state == MachineState::SingleBlock) message = "single block";
  if (state == MachineState::Running && machine_.panel().handwheel)
    message = "driven by the handwheel";
  return execution_of(state);
}

}  // namespace dripline::gateway
