#pragma once

#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/machine/impl/executor.hpp"
#include "gateway/machine/machine_limits.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::machine {

/// A machine of our own making: queues what the program does and executes it in order, in machine
/// time. Pure and deterministic: no thread, socket or clock; time comes in by `poll`.
/// The same events and the same calls at the same machine times give the same execution, however
/// finely time is sliced. The axes follow without a following error, `begin` places them anywhere,
/// and input pins read low.
///
/// Memory is fixed at construction (about 4 MiB). No call allocates, except for alarms and
/// warnings.
class SimulatedMachine final : public MotionBackend {
 public:
  /// `sink` must outlive the machine. `limits` must pass check(). Probes meet the workpiece.
  SimulatedMachine(const MachineLimits& limits, interpreter::Workpiece workpiece,
                   ExecutionSink& sink);
  SimulatedMachine(const SimulatedMachine&) = delete;
  SimulatedMachine& operator=(const SimulatedMachine&) = delete;

  const MotionCapabilities& capabilities() const override { return capabilities_; }
  Result<void> check_begin(const interpreter::Position&) const override { return {}; }
  std::unique_ptr<MotionCheck> make_test(const interpreter::Position& at) const override;
  void begin(const interpreter::Position& at) override { executor_.begin(at); }
  void begin_next(const interpreter::Position& at) override { executor_.begin_next(at); }

  interpreter::EventSink& events() override { return queue_builder_; }
  /// A block that has more than kBlockReserve actions or kTextReserve bytes of text beyond this
  /// becomes an alarm (MCH0005). After a block with more text than that, each waits until all
  /// text is written: what has fit once fits again.
  bool has_room() const override {
    if (queue_.size() >= kQueuedActions || queue_.texts().free() < kTextReserve) return false;
    return queue_builder_.largest_text() <= kTextReserve || queue_.texts().is_empty();
  }
  static constexpr std::size_t kQueuedActions = 8192;
  static constexpr std::size_t kBlockReserve = 8192;
  static constexpr std::size_t kQueuedText = 512 * 1024;
  static constexpr std::size_t kTextReserve = 128 * 1024;
  void begin_probe(const interpreter::Probe& probe) override { queue_builder_.begin_probe(probe); }
  bool input(int /*pin*/) const override { return false; }
  bool drained() const override { return queue_.empty(); }
  Seconds buffered() const override { return Seconds{executor_.buffered()}; }

  /// Returns less than `elapsed` when it ran out of actions, is at standstill, or used up
  /// `max_actions`.
  Seconds poll(Seconds elapsed, std::size_t max_actions = kNoLimit) override {
    return Seconds{executor_.advance(elapsed.count(), max_actions)};
  }
  /// As fast as possible: no limit of time.
  Seconds poll_all(std::size_t max_actions = kNoLimit) {
    return poll(Seconds{std::numeric_limits<double>::infinity()}, max_actions);
  }

  const OperatorPanel& panel() const override { return executor_.panel(); }
  void set_panel(const OperatorPanel& panel) override { executor_.set_panel(panel); }
  void hold() override { executor_.hold(); }
  bool resume() override { return executor_.resume(); }
  /// A tapping cycle is left out, with a message.
  void turn_handwheel(Seconds program_time) override {
    executor_.turn_handwheel(program_time.count());
  }
  void abort() override { executor_.abort(); }
  Result<void> jog(const Jog& jog) override { return executor_.jog(jog); }
  bool is_jogging() const override { return executor_.is_jogging(); }
  void stop_jog() override { executor_.stop_jog(); }

  MachineState state() const override { return executor_.state(); }
  bool is_moving() const override { return executor_.is_moving(); }
  MachineStatus status() const override { return executor_.status(); }

 private:
  MotionCapabilities capabilities_{.axes = {},
                                   .arcs = true,
                                   .threads = true,
                                   .spindle_feedback = true,
                                   .probing = true,
                                   .arc_probing = true,
                                   .rapid_probing = true,
                                   .feed_override = true,
                                   .rapid_override = true,
                                   .spindle_override = true,
                                   .single_block = true,
                                   .dry_run = true,
                                   .handwheel = true,
                                   .simulated_time = true,
                                   .places_axes = true,
                                   .tool_lengths = true,
                                   .jog = true};
  // Each refers to those above it.
  const MachineLimits limits_;
  const interpreter::Workpiece workpiece_;
  impl::ActionQueue queue_;
  impl::MotionQueueBuilder queue_builder_;
  impl::Executor executor_;
};

}  // namespace dripline::machine
