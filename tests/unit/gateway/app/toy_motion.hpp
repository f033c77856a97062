#pragma once

#include <deque>
#include <functional>

#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// A back end for tests of the gateway alone, with nearly no capabilities: it moves the X axis on
/// straight lines, each within one poll, at the pace of the caller's polls. It cannot place its
/// axis and its input pins read high.
class ToyMotion : public machine::MotionBackend, private interpreter::EventSink {
 public:
  /// `checks`: its programs are looked through before they move.
  explicit ToyMotion(machine::ExecutionSink& sink, bool checks = false)
      : sink_(sink), checks_(checks) {
    capabilities_.axes.set(static_cast<std::size_t>(interpreter::Axis::X));
  }

  const machine::MotionCapabilities& capabilities() const override { return capabilities_; }
  Result<void> check_begin(const interpreter::Position& at) const override;
  std::unique_ptr<machine::MotionCheck> make_check(const interpreter::Position& at) const override;
  void begin(const interpreter::Position& at) override;
  interpreter::EventSink& events() override { return *this; }
  bool has_room() const override { return queue_.size() < 16; }
  void begin_probe(const interpreter::Probe&) override {}
  bool input(int) const override { return true; }
  bool drained() const override { return queue_.empty(); }
  machine::Seconds buffered() const override { return machine::Seconds{0}; }
  machine::Seconds poll(machine::Seconds elapsed, std::size_t max_actions) override;
  const machine::OperatorPanel& panel() const override { return panel_; }
  void set_panel(const machine::OperatorPanel& panel) override { panel_ = panel.clamped(); }
  void hold() override { is_held_ = true; }
  bool resume() override { return std::exchange(is_held_, false); }
  void turn_handwheel(machine::Seconds) override {}
  void abort() override;
  machine::MachineState state() const override;
  bool is_moving() const override { return false; }
  machine::MachineStatus status() const override;

 private:
  void on_line(const interpreter::Line& line) override;
  void on_output(const interpreter::Output& output) override;
  void on_alarm(const interpreter::Alarm& alarm) override;
  void on_end(const interpreter::End& end) override;
  void on_block_end(const interpreter::Origin& origin) override;
  void queue(std::function<void()> action);

  machine::ExecutionSink& sink_;
  const bool checks_;
  machine::MotionCapabilities capabilities_;
  machine::OperatorPanel panel_;
  machine::MachineStatus status_;
  std::deque<std::function<void()>> queue_;
  bool is_held_ = false, is_silent_ = false;
};

}  // namespace dripline::gateway
