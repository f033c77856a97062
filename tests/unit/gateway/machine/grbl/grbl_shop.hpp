#pragma once

#include <gtest/gtest.h>
#include <cmath>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/support/grbl/board.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::grbl::test {

using interpreter::Axis;
using interpreter::Position;
using machine::test::Program;
using machine::test::Recorder;
using test_support::GrblBoard;

/// A machine and its board on a line without a device, in virtual time: the line's side is served
/// every millisecond, the owner polls every ten.
class GrblShop {
 public:
  explicit GrblShop(GrblBoard::Options options = {}, SessionLimits limits = {},
                    interpreter::MachineData stated = {})
      : board(std::move(options)),
        machine({.sink = recorder, .clock = clock, .machine = stated, .limits = limits}),
        program(machine.events()) {
    machine.line_opened();
    pass(1);
  }

  void pass(double seconds) {
    for (long i = std::lround(seconds * 1000); i > 0; --i) step();
  }
  /// Within virtual `seconds`.
  template <class Predicate>
  bool pass_until(Predicate holds, double seconds = 60) {
    for (int i = 0; i < static_cast<int>(seconds * 1000); ++i) {
      if (holds()) return true;
      step();
    }
    return holds();
  }
  bool pass_until_over(double seconds = 600) {
    return pass_until(
        [&] {
          const MachineState state = machine.state();
          return state == MachineState::Completed || state == MachineState::Alarmed ||
                 state == MachineState::Aborted;
        },
        seconds);
  }
  void begin(double x = 0, double z = 0) {
    machine.begin(Program::at(x, z));
    is_polled = true;
  }
  bool has(const std::string& line) const {
    return std::ranges::find(recorder.lines, line) != recorder.lines.end();
  }
  std::string alarm() const {
    for (const std::string& line : recorder.lines)
      if (line.starts_with("alarm ")) return line.substr(6);
    return {};
  }
  double x() const { return machine.status().position.raw(Axis::X); }
  double z() const { return machine.status().position.raw(Axis::Z); }

  bool is_polled = false;  ///< a run is active: the owner polls
  bool is_cut = false;     ///< nothing passes the line
  std::shared_ptr<test_support::ManualClock> clock = std::make_shared<test_support::ManualClock>();
  GrblBoard board;
  Recorder recorder;
  GrblMachine machine;
  Program program;

 private:
  void step() {
    clock->advance(std::chrono::milliseconds(1));
    board.pass(0.001);
    const std::string in = is_cut ? std::string() : board.take_output();
    const BoardOutput out = machine.exchange(std::as_bytes(std::span(in)));
    if (!is_cut) board.receive(out.real_time + out.lines);
    if (++steps_ % 10 == 0 && is_polled) (void)machine.poll(Seconds{0.01}, 512);
    // No report is ahead of the axes.
    EXPECT_LE(machine.status().executed, true_block_limit()) << "claimed before it was done";
  }
  /// For programs of one line a block only; others set `checks_truth` to false.
  std::uint64_t true_block_limit() const {
    return checks_truth ? board.done.size() + silent_blocks : UINT64_MAX;
  }

 public:
  bool checks_truth = false;
  std::size_t silent_blocks = 0;  ///< blocks without motion

 private:
  int steps_ = 0;
};

}  // namespace dripline::machine::grbl::test
