#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gateway/interpreter/stages/event_filter.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// Writes down, one line an event and to the last bit, what a machine is given: "12 line X1 Y2",
/// and "12 end" where a block ends. Texts for people are left out.
class PathWriter final : public interpreter::EventFilter {
 public:
  using Write = std::function<void(std::string line)>;
  PathWriter(interpreter::EventSink& out, Write write)
      : EventFilter(out), write_(std::move(write)) {}

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_dwell(const interpreter::Dwell& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_pin(const interpreter::PinChange& event) override;
  void on_output(const interpreter::Output& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_alarm(const interpreter::Alarm& event) override;
  void on_end(const interpreter::End& event) override;
  void on_block_end(const interpreter::Origin& origin) override;
  void probe(const interpreter::Probe& probe);

 private:
  void write(const interpreter::Origin& origin, const std::string& what);
  Write write_;
};

/// A back end that writes down what it is given.
class RecordingMotion final : public machine::MotionBackend {
 public:
  RecordingMotion(std::unique_ptr<machine::MotionBackend> machine, PathWriter::Write write)
      : machine_(std::move(machine)), path_(machine_->events(), std::move(write)) {}

  const machine::MotionCapabilities& capabilities() const override {
    return machine_->capabilities();
  }
  Result<void> check_begin(const interpreter::Position& at) const override {
    return machine_->check_begin(at);
  }
  void begin(const interpreter::Position& at) override { machine_->begin(at); }
  interpreter::EventSink& events() override { return path_; }
  bool has_room() const override { return machine_->has_room(); }
  void begin_probe(const interpreter::Probe& probe) override {
    path_.probe(probe);
    machine_->begin_probe(probe);
  }
  bool input(int pin) const override { return machine_->input(pin); }
  bool drained() const override { return machine_->drained(); }
  machine::Seconds buffered() const override { return machine_->buffered(); }
  machine::Seconds poll(machine::Seconds elapsed, std::size_t max_actions) override {
    return machine_->poll(elapsed, max_actions);
  }
  const machine::OperatorPanel& panel() const override { return machine_->panel(); }
  void set_panel(const machine::OperatorPanel& panel) override { machine_->set_panel(panel); }
  void hold() override { machine_->hold(); }
  bool resume() override { return machine_->resume(); }
  void turn_handwheel(machine::Seconds time) override { machine_->turn_handwheel(time); }
  void abort() override { machine_->abort(); }
  machine::MachineState state() const override { return machine_->state(); }
  bool is_moving() const override { return machine_->is_moving(); }
  machine::MachineStatus status() const override { return machine_->status(); }

 private:
  std::unique_ptr<machine::MotionBackend> machine_;
  PathWriter path_;
};

}  // namespace dripline::gateway
