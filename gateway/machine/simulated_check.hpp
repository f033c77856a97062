#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gateway/machine/simulated_machine.hpp"

namespace dripline::machine {

/// A test run's own machine: executes a whole program at once, with the limits and the workpiece of
/// a simulated machine that keeps its place. Stops are passed over.
class SimulatedCheck final : public MotionCheck {
 public:
  /// `limits` must pass check(). The program begins at `at`.
  SimulatedCheck(const MachineLimits& limits, const interpreter::Workpiece& workpiece,
                 const interpreter::Position& at);

  interpreter::EventSink& events() override { return machine_.events(); }
  const std::optional<interpreter::Diagnostic>& refusal() const override { return sink_.alarm; }
  void pass_block() override;
  std::optional<interpreter::ProbeResult> probe(const interpreter::Probe& probe) override;
  std::optional<Seconds> motion_time() const override { return seconds_; }

 private:
  struct Sink final : ExecutionSink {
    void on_alarm(const interpreter::Alarm& alarm_of_program) override;
    void on_probed(const interpreter::Probe& probe) override { probed = probe.result; }
    std::optional<interpreter::Diagnostic> alarm;
    std::optional<interpreter::ProbeResult> probed;
  };

  Sink sink_;
  SimulatedMachine machine_;
  Seconds seconds_{0};
};

}  // namespace dripline::machine
