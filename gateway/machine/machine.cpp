#include "gateway/machine/machine.hpp"

#include "gateway/machine/impl/executor.hpp"

namespace dripline::machine {

using impl::ActionQueue;
using impl::Executor;
using impl::Intake;

/// Everything refers to everything above it, so it stays in one place.
struct Machine::Parts {
  Parts(const MachineLimits& its_limits, interpreter::Workpiece its_workpiece, ExecutionSink& sink)
      : limits(its_limits),
        workpiece(std::move(its_workpiece)),
        queue(kQueuedActions + kBlockReserve, kQueuedText + kTextReserve),
        intake(limits, queue),
        executor({.limits = limits,
                  .workpiece = workpiece,
                  .queue = queue,
                  .intake = intake,
                  .sink = sink}) {}

  const MachineLimits limits;
  const interpreter::Workpiece workpiece;
  ActionQueue queue;
  Intake intake;
  Executor executor;
};

Machine::Machine(const MachineLimits& limits, interpreter::Workpiece workpiece, ExecutionSink& sink)
    : parts_(std::make_unique<Parts>(limits, std::move(workpiece), sink)) {
  parts_->executor.begin({});
}

Machine::~Machine() = default;

const MachineLimits& Machine::limits() const {
  return parts_->limits;
}

void Machine::begin(const interpreter::Position& at) {
  parts_->executor.begin(at);
}

interpreter::EventSink& Machine::events() {
  return parts_->intake;
}

bool Machine::has_room() const {
  return parts_->queue.size() < kQueuedActions && parts_->queue.texts().free() >= kTextReserve;
}

void Machine::begin_probe(const interpreter::Probe& probe) {
  parts_->intake.begin_probe(probe);
}

bool Machine::drained() const {
  return parts_->queue.empty();
}

Seconds Machine::buffered() const {
  return Seconds{parts_->executor.buffered()};
}

Seconds Machine::advance(Seconds by, std::size_t max_actions) {
  return Seconds{parts_->executor.advance(by.count(), max_actions)};
}

const OperatorPanel& Machine::panel() const {
  return parts_->executor.panel();
}
void Machine::set_panel(const OperatorPanel& panel) {
  parts_->executor.set_panel(panel);
}
void Machine::hold() {
  parts_->executor.hold();
}
bool Machine::resume() {
  return parts_->executor.resume();
}
void Machine::turn_handwheel(Seconds program_time) {
  parts_->executor.turn_handwheel(program_time.count());
}
void Machine::abort() {
  parts_->executor.abort();
}
MachineState Machine::state() const {
  return parts_->executor.state();
}
bool Machine::is_moving() const {
  return parts_->executor.is_moving();
}
MachineStatus Machine::status() const {
  return parts_->executor.status();
}

std::string_view to_string(MachineState state) {
  switch (state) {
    case MachineState::Idle:
      return "idle";
    case MachineState::Running:
      return "running";
    case MachineState::Held:
      return "held";
    case MachineState::ProgramStop:
      return "program_stop";
    case MachineState::OptionalStop:
      return "optional_stop";
    case MachineState::SingleBlock:
      return "single_block";
    case MachineState::Completed:
      return "completed";
    case MachineState::Alarmed:
      return "alarmed";
    case MachineState::Aborted:
      return "aborted";
    case MachineState::EmergencyStop:
      return "emergency_stop";
  }
  return "unknown";
}

}  // namespace dripline::machine
