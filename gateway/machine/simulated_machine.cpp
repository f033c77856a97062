#include "gateway/machine/simulated_machine.hpp"

#include "gateway/machine/impl/executor.hpp"

namespace dripline::machine {

using impl::ActionQueue;
using impl::Executor;
using impl::MotionQueueBuilder;

/// Everything refers to everything above it, so it stays in one place.
struct SimulatedMachine::Parts {
  Parts(const MachineLimits& its_limits, interpreter::Workpiece its_workpiece, ExecutionSink& sink)
      : limits(its_limits),
        workpiece(std::move(its_workpiece)),
        queue(kQueuedActions + kBlockReserve, kQueuedText + kTextReserve),
        queue_builder(limits, queue),
        executor({.limits = limits,
                  .workpiece = workpiece,
                  .queue = queue,
                  .queue_builder = queue_builder,
                  .sink = sink}) {
    for (std::size_t i = 0; i < limits.axes.size(); ++i)
      capabilities.axes.set(i, limits.axes[i].has_value());
  }

  MotionCapabilities capabilities{.axes = {},
                                  .arcs = true,
                                  .threads = true,
                                  .spindle_feedback = true,
                                  .probing = true,
                                  .feed_override = true,
                                  .rapid_override = true,
                                  .spindle_override = true,
                                  .single_block = true,
                                  .handwheel = true,
                                  .simulated_time = true,
                                  .places_axes = true};
  const MachineLimits limits;
  const interpreter::Workpiece workpiece;
  ActionQueue queue;
  MotionQueueBuilder queue_builder;
  Executor executor;
};

SimulatedMachine::SimulatedMachine(const MachineLimits& limits, interpreter::Workpiece workpiece,
                                   ExecutionSink& sink)
    : parts_(std::make_unique<Parts>(limits, std::move(workpiece), sink)) {
  parts_->executor.begin({});
}

SimulatedMachine::~SimulatedMachine() = default;

const MotionCapabilities& SimulatedMachine::capabilities() const {
  return parts_->capabilities;
}

Result<void> SimulatedMachine::check_begin(const interpreter::Position&) const {
  return {};
}

void SimulatedMachine::begin(const interpreter::Position& at) {
  parts_->executor.begin(at);
}

interpreter::EventSink& SimulatedMachine::events() {
  return parts_->queue_builder;
}

bool SimulatedMachine::has_room() const {
  return parts_->queue.size() < kQueuedActions && parts_->queue.texts().free() >= kTextReserve;
}

void SimulatedMachine::begin_probe(const interpreter::Probe& probe) {
  parts_->queue_builder.begin_probe(probe);
}

bool SimulatedMachine::input(int) const {
  return false;
}

bool SimulatedMachine::drained() const {
  return parts_->queue.empty();
}

Seconds SimulatedMachine::buffered() const {
  return Seconds{parts_->executor.buffered()};
}

Seconds SimulatedMachine::poll(Seconds elapsed, std::size_t max_actions) {
  return Seconds{parts_->executor.advance(elapsed.count(), max_actions)};
}

const OperatorPanel& SimulatedMachine::panel() const {
  return parts_->executor.panel();
}
void SimulatedMachine::set_panel(const OperatorPanel& panel) {
  parts_->executor.set_panel(panel);
}
void SimulatedMachine::hold() {
  parts_->executor.hold();
}
bool SimulatedMachine::resume() {
  return parts_->executor.resume();
}
void SimulatedMachine::turn_handwheel(Seconds program_time) {
  parts_->executor.turn_handwheel(program_time.count());
}
void SimulatedMachine::abort() {
  parts_->executor.abort();
}
MachineState SimulatedMachine::state() const {
  return parts_->executor.state();
}
bool SimulatedMachine::is_moving() const {
  return parts_->executor.is_moving();
}
MachineStatus SimulatedMachine::status() const {
  return parts_->executor.status();
}

}  // namespace dripline::machine
