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

/// Forwards what a machine has done; then `on_block` is called for a block.
class BlockWatch final : public machine::ExecutionSink {
 public:
  using OnBlock = std::function<void(std::uint64_t block)>;
  BlockWatch(machine::ExecutionSink& out, OnBlock on_block)
      : out_(out), on_block_(std::move(on_block)) {}

  void on_block_executed(const interpreter::Origin& origin) override {
    out_.on_block_executed(origin);
    on_block_(origin.block);
  }
  bool on_motion_starts(const interpreter::Origin& at) override {
    return out_.on_motion_starts(at);
  }
  void on_output(const interpreter::Output& event) override { out_.on_output(event); }
  void on_open(const interpreter::Open& event) override { out_.on_open(event); }
  void on_close(const interpreter::Close& event) override { out_.on_close(event); }
  void on_message(const interpreter::Message& event) override { out_.on_message(event); }
  void on_warning(const interpreter::Warning& event) override { out_.on_warning(event); }
  void on_spindle(const interpreter::Spindle& event) override { out_.on_spindle(event); }
  void on_coolant(const interpreter::Coolant& event) override { out_.on_coolant(event); }
  void on_tool(const interpreter::ToolChange& event) override { out_.on_tool(event); }
  void on_miscellaneous(const interpreter::Miscellaneous& event) override {
    out_.on_miscellaneous(event);
  }
  void on_pin(const interpreter::PinChange& event) override { out_.on_pin(event); }
  void on_probed(const interpreter::Probe& event) override { out_.on_probed(event); }
  void on_stop(const interpreter::Stop& event) override { out_.on_stop(event); }
  void on_alarm(const interpreter::Alarm& event) override { out_.on_alarm(event); }
  void on_end(const interpreter::End& event) override { out_.on_end(event); }
  void on_aborted() override { out_.on_aborted(); }

 private:
  machine::ExecutionSink& out_;
  OnBlock on_block_;
};

/// A back end that writes down what it is given.
class RecordingMotion final : public machine::MotionBackend {
 public:
  RecordingMotion(const machine::MotionFactory& make, machine::ExecutionSink& sink,
                  BlockWatch::OnBlock on_block, PathWriter::Write write)
      : watch_(sink, std::move(on_block)),
        machine_(make(watch_)),
        path_(machine_->events(), std::move(write)) {}

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
  BlockWatch watch_;
  std::unique_ptr<machine::MotionBackend> machine_;
  PathWriter path_;
};

}  // namespace dripline::gateway
