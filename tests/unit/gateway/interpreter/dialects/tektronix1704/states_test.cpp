#include <gtest/gtest.h>
#include <string>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "gateway/machine/simulated_machine.hpp"

/// What the panel's lamps and buttons stand for, as states of the machine after the control. Rows:
/// TK-31, TK-35, TK-46, TK-57.
namespace dripline::interpreter {
namespace {

using machine::MachineState;

/// A tape on the simulated mill; CYCLE START is `resume`.
class Station {
 public:
  explicit Station(std::string tape, bool optional_stop = false)
      : tape_("%\nF1000\n" + std::move(tape)),
        source_(tape_),
        machine_(limits(), Workpiece{}, nobody_) {
    machine::OperatorPanel panel;
    panel.optional_stop = optional_stop;
    machine_.set_panel(panel);
    Setup setup;
    setup.switches.optional_stop = optional_stop;
    interpreter_ = std::move(*control().make(setup, source_, machine_.events()));
    machine_.begin(setup.start);
  }

  /// Until it stops for good.
  machine::MachineStatus run() {
    StepState step = StepState::Ran;
    while (step == StepState::Ran && machine_.has_room()) step = interpreter_->step(1);
    machine_.poll_all();
    return machine_.status();
  }
  machine::MachineStatus cycle_start() {
    EXPECT_TRUE(machine_.resume());
    return run();
  }

 private:
  static const Dialect& control() { return **find_dialect("tektronix-1704"); }
  static machine::MachineLimits limits() {
    auto limits = machine::MachineLimits::mill();
    limits.waits_at_tool_change = control().waits_at_tool_change;
    return limits;
  }
  class Nobody final : public machine::ExecutionSink {};

  std::string tape_;
  MemorySource source_;
  Nobody nobody_;
  machine::SimulatedMachine machine_;
  std::unique_ptr<Interpreter> interpreter_;
};

TEST(States, AProgramStopStandsAfterItsMoveUntilCycleStart) {
  Station station("X10000M00\nX20000\nM02\n");
  const auto stopped = station.run();
  EXPECT_EQ(stopped.state, MachineState::ProgramStop);
  EXPECT_EQ(stopped.stopped_at, StopKind::Program);
  EXPECT_NEAR(stopped.position.linear(Axis::X).inch(), 1, 1e-9);
  const auto ended = station.cycle_start();
  EXPECT_EQ(ended.state, MachineState::Completed);
  EXPECT_NEAR(ended.position.linear(Axis::X).inch(), 2, 1e-9);
}

TEST(States, TheOptionalStopNeedsItsSwitch) {
  EXPECT_EQ(Station("X10000M01\nM02\n", true).run().state, MachineState::OptionalStop);
  EXPECT_EQ(Station("X10000M01\nM02\n", false).run().state, MachineState::Completed);
}

TEST(States, AToolChangeByHandLightsItsLampUntilCycleStart) {
  Station station("X10000M06\nM30\n");
  const auto lamp = station.run();
  EXPECT_EQ(lamp.state, MachineState::ProgramStop);
  EXPECT_EQ(lamp.stopped_at, StopKind::ToolChange);
  EXPECT_EQ(station.cycle_start().state, MachineState::Completed);
}

TEST(States, ABoringCycleStopsAtTheBottom) {
  Station station("G87X10000R1000Z-5000\nM30\n");
  const auto bottom = station.run();
  EXPECT_EQ(bottom.stopped_at, StopKind::Program);
  EXPECT_NEAR(bottom.position.linear(Axis::Z).inch(), -0.5, 1e-9);
  const auto out = station.cycle_start();
  EXPECT_EQ(out.state, MachineState::Completed);
  EXPECT_NEAR(out.position.linear(Axis::Z).inch(), 0.1, 1e-9);
}

TEST(States, WhatDoesNotReadIsAnAlarmAtItsBlock) {
  const auto alarmed = Station("X10000\nX1#\n").run();
  EXPECT_EQ(alarmed.state, MachineState::Alarmed);
  EXPECT_NEAR(alarmed.position.linear(Axis::X).inch(), 1, 1e-9) << "the move before is finished";
}

}  // namespace
}  // namespace dripline::interpreter
