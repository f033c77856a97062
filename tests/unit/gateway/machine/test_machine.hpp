#pragma once

#include <fmt/format.h>
#include <cmath>
#include <string>
#include <vector>

#include "gateway/machine/simulated_machine.hpp"

namespace dripline::machine::test {

using interpreter::Axis;
using interpreter::Origin;
using interpreter::Position;

/// Writes down what is executed, one line each: "block 3", "output hello".
class Recorder final : public ExecutionSink {
 public:
  std::vector<std::string> lines;
  std::vector<std::uint64_t> blocks;
  std::vector<interpreter::Probe> probes;

  void on_block_executed(const Origin& origin) override {
    blocks.push_back(origin.block);
    if (writes_blocks) lines.push_back(fmt::format("block {}", origin.block));
  }
  bool on_motion_starts(const Origin&) override { return !is_disk_full; }
  void on_output(const interpreter::Output& e) override { add("output", e.text); }
  void on_open(const interpreter::Open& e) override { add("open", e.name.value_or("-")); }
  void on_close(const interpreter::Close&) override { lines.push_back("close"); }
  void on_message(const interpreter::Message& e) override { add("message", e.text); }
  void on_warning(const interpreter::Warning& e) override {
    lines.push_back(fmt::format("warning {} {}", e.diagnostic.id, e.diagnostic.text));
  }
  void on_spindle(const interpreter::Spindle&) override { lines.push_back("spindle"); }
  void on_coolant(const interpreter::Coolant& e) override {
    lines.push_back(fmt::format("coolant {} {}", e.flood, e.mist));
  }
  void on_tool(const interpreter::ToolChange& e) override {
    lines.push_back(fmt::format("tool {}", e.number));
  }
  void on_miscellaneous(const interpreter::Miscellaneous& e) override {
    lines.push_back(fmt::format("misc {}", e.code));
  }
  void on_pin(const interpreter::PinChange& e) override {
    lines.push_back(fmt::format("pin {} {}", e.output, e.state));
  }
  void on_probed(const interpreter::Probe& e) override {
    probes.push_back(e);
    lines.push_back("probed");
  }
  void on_stop(const interpreter::Stop&) override { lines.push_back("stop"); }
  void on_alarm(const interpreter::Alarm& e) override {
    lines.push_back(fmt::format("alarm {} {}", e.diagnostic.id, e.diagnostic.text));
  }
  void on_end(const interpreter::End&) override { lines.push_back("end"); }
  void on_aborted() override { lines.push_back("aborted"); }

  bool writes_blocks = true;
  bool is_disk_full = false;  ///< nothing begins

 private:
  void add(const char* what, std::string_view text) {
    lines.push_back(fmt::format("{} {}", what, text));
  }
};

/// Plays the interpreter: every call is one block unless stated otherwise.
class Program {
 public:
  explicit Program(interpreter::EventSink& sink) : sink_(sink) {}

  std::uint64_t blocks() const { return origin_.block; }
  const Origin& begin_block() {
    ++origin_.block;
    ++origin_.line;
    return origin_;
  }
  void end_block() { sink_.on_block_end(origin_); }
  void empty() {
    begin_block();
    end_block();
  }
  /// Moves an X/Z lathe; `feed` in mm/min.
  void line(double x, double z, double feed) { line(x, z, Feed::per_minute(Length::mm(feed))); }
  void line(double x, double z, Feed feed) {
    begin_block();
    sink_.on_line({origin_, at(x, z), feed});
    end_block();
  }
  void line_to_rest(double x, double z, double feed) {
    begin_block();
    sink_.on_line({origin_, at(x, z), Feed::per_minute(Length::mm(feed)), true});
    end_block();
  }
  void rapid(double x, double z, bool rests = true) {
    begin_block();
    sink_.on_rapid({origin_, at(x, z), rests});
    end_block();
  }
  void arc(double x, double z, double center_z, double center_x, double sweep, double feed,
           interpreter::Turn turn = interpreter::Turn::Counterclockwise) {
    begin_block();
    sink_.on_arc({.origin = origin_,
                  .to = at(x, z),
                  .center_first = Length::mm(center_z),
                  .center_second = Length::mm(center_x),
                  .plane = interpreter::Plane::ZX,
                  .turn = turn,
                  .sweep = Angle::degrees(sweep),
                  .feed = Feed::per_minute(Length::mm(feed))});
    end_block();
  }
  void thread(double x, double z, double lead) {
    begin_block();
    sink_.on_thread({origin_, at(x, z), Length::mm(lead), std::nullopt});
    end_block();
  }
  /// No block of its own.
  void lock(interpreter::OverrideInhibit lock) {
    lock.origin = origin_;
    sink_.on_override_inhibit(lock);
  }
  void unlock() { lock({}); }
  void revolve(double revolutions) {
    begin_block();
    sink_.on_dwell({origin_, 0, revolutions});
    end_block();
  }
  void dwell(double seconds) {
    begin_block();
    sink_.on_dwell({origin_, seconds, std::nullopt});
    end_block();
  }
  void spindle(double rpm) {
    begin_block();
    sink_.on_spindle({origin_, interpreter::SpindleState::Clockwise, rpm, {}, {}});
    end_block();
  }
  void surface_speed(double mm_per_minute, std::optional<double> max_rpm) {
    begin_block();
    sink_.on_spindle(
        {origin_, interpreter::SpindleState::Clockwise, 0, Length::mm(mm_per_minute), max_rpm});
    end_block();
  }
  void output(std::string_view text) {
    begin_block();
    sink_.on_output({origin_, interpreter::OutputDevice::File, text});
    end_block();
  }
  void stop(interpreter::StopKind kind = interpreter::StopKind::Program) {
    begin_block();
    sink_.on_stop({origin_, kind});
    end_block();
  }
  void end() {
    begin_block();
    sink_.on_end({origin_, origin_.block, false});
    end_block();
  }

  static Position at(double x, double z) {
    Position position;
    position.set(Axis::X, Length::mm(x));
    position.set(Axis::Z, Length::mm(z));
    return position;
  }

 private:
  interpreter::EventSink& sink_;
  Origin origin_;
};

/// 1000 mm/s^2, 100 mm/s rapid on both axes, feeds up to 50 mm/s: round figures for closed
/// formulas.
inline MachineLimits plain_lathe() {
  MachineLimits limits;
  limits.axis(Axis::X) = limits.axis(Axis::Z) =
      AxisLimits{.rapid_per_minute = 6000, .feed_per_minute = 3000, .acceleration = 1000};
  limits.spindle.max_rpm = 3000;
  return limits;
}

struct TestMachine {
  explicit TestMachine(const MachineLimits& limits = plain_lathe(),
                       interpreter::Workpiece workpiece = {})
      : machine(limits, std::move(workpiece), recorder), program(machine.events()) {}

  double run_all() { return machine.poll_all().count(); }
  double x() const { return machine.status().position.linear(Axis::X).mm(); }
  double z() const { return machine.status().position.linear(Axis::Z).mm(); }

  Recorder recorder;
  SimulatedMachine machine;
  Program program;
};

/// Seconds from rest to rest over `length` at `speed` with `acceleration`.
inline double trapezoid(double length, double speed, double acceleration) {
  if (speed * speed / acceleration >= length) return 2 * std::sqrt(length / acceleration);
  return length / speed + speed / acceleration;
}

}  // namespace dripline::machine::test
