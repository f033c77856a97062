#pragma once

#include "gateway/interpreter/core/geometry/workpiece.hpp"
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
  ~SimulatedMachine() override;
  SimulatedMachine(const SimulatedMachine&) = delete;
  SimulatedMachine& operator=(const SimulatedMachine&) = delete;

  const MotionCapabilities& capabilities() const override;
  Result<void> check_begin(const interpreter::Position& at) const override;
  void begin(const interpreter::Position& at) override;

  interpreter::EventSink& events() override;
  /// A block that has more than kBlockReserve actions or kTextReserve bytes of text beyond this
  /// becomes an alarm (MCH0005).
  bool has_room() const override;
  static constexpr std::size_t kQueuedActions = 8192;
  static constexpr std::size_t kBlockReserve = 8192;
  static constexpr std::size_t kQueuedText = 512 * 1024;
  static constexpr std::size_t kTextReserve = 128 * 1024;

  void begin_probe(const interpreter::Probe& probe) override;
  bool input(int pin) const override;
  bool drained() const override;
  Seconds buffered() const override;

  /// Returns less than `elapsed` when it ran out of actions, is at standstill, or used up
  /// `max_actions`.
  Seconds poll(Seconds elapsed, std::size_t max_actions = kNoLimit) override;
  /// As fast as possible: no limit of time.
  Seconds poll_all(std::size_t max_actions = kNoLimit) {
    return poll(Seconds{std::numeric_limits<double>::infinity()}, max_actions);
  }

  const OperatorPanel& panel() const override;
  void set_panel(const OperatorPanel& panel) override;
  void hold() override;
  bool resume() override;
  /// A tapping cycle is left out, with a message.
  void turn_handwheel(Seconds program_time) override;
  void abort() override;

  MachineState state() const override;
  bool is_moving() const override;
  MachineStatus status() const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dripline::machine
