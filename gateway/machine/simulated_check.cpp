#include "gateway/machine/simulated_check.hpp"

#include <utility>

namespace dripline::machine {

void SimulatedCheck::Sink::on_alarm(const interpreter::Alarm& alarm_of_program) {
  if (!alarm) alarm = alarm_of_program.diagnostic;
}

SimulatedCheck::SimulatedCheck(const MachineLimits& limits, const interpreter::Workpiece& workpiece,
                               const interpreter::Position& at)
    : machine_(limits, workpiece, sink_) {
  machine_.begin(at);
}

void SimulatedCheck::pass_block() {
  do {
    seconds_ += machine_.poll_all();
  } while (machine_.resume());
}

std::optional<interpreter::ProbeResult> SimulatedCheck::probe(const interpreter::Probe& probe) {
  pass_block();
  machine_.begin_probe(probe);
  pass_block();
  return std::exchange(sink_.probed, std::nullopt);
}

}  // namespace dripline::machine
