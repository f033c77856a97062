#include "gateway/machine/simulated_machine.hpp"

#include <utility>

#include "gateway/machine/simulated_check.hpp"

namespace dripline::machine {

SimulatedMachine::SimulatedMachine(const MachineLimits& limits, interpreter::Workpiece workpiece,
                                   ExecutionSink& sink)
    : limits_(limits),
      workpiece_(std::move(workpiece)),
      queue_(kQueuedActions + kBlockReserve, kQueuedText + kTextReserve),
      queue_builder_(limits_, queue_),
      executor_({.limits = limits_,
                 .workpiece = workpiece_,
                 .queue = queue_,
                 .queue_builder = queue_builder_,
                 .sink = sink}) {
  for (std::size_t i = 0; i < limits_.axes.size(); ++i)
    capabilities_.axes.set(i, limits_.axes[i].has_value());
  executor_.begin({});
}

std::unique_ptr<MotionCheck> SimulatedMachine::make_test(const interpreter::Position& at) const {
  return std::make_unique<SimulatedCheck>(limits_, workpiece_, at);
}

}  // namespace dripline::machine
