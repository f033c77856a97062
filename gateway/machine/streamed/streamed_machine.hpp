#pragma once

#include <memory>
#include <mutex>

#include "gateway/interpreter/core/machine_data.hpp"
#include "gateway/machine/motion_backend.hpp"
#include "gateway/machine/streamed/device.hpp"
#include "gateway/machine/streamed/motion_queue.hpp"

namespace dripline::machine::streamed {

/// A controller that reads lines of text, as what moves the axes: the program's motion is streamed
/// ahead; whatever is not motion waits until the motion before it is executed, and the motion after
/// it waits for it. So a record is on disk before the axes move on.
///
/// The owner's functions are those of MotionBackend, on one thread. The link's thread calls
/// `with_device` and `pump`; a mutex is between them. The sink is called without it.
class StreamedMachine : public MotionBackend {
 public:
  struct Parts {
    ExecutionSink& sink;
    std::shared_ptr<const Clock> clock;
    std::unique_ptr<CommandWriter> (*make_commands)();
    interpreter::MachineData machine = {};  ///< what the setup states; the device must agree
    MotionCapabilities capabilities = {};   ///< the axes are the device's
  };
  /// `device` is a member of the derived class; it is not used before its constructor ends.
  StreamedMachine(Parts parts, Device& device);
  ~StreamedMachine() override;

  const MotionCapabilities& capabilities() const override;
  /// Errors: those of Device::check_ready; Conflict (another machine than the setup states, the
  /// axes are elsewhere).
  Result<void> check_begin(const interpreter::Position& at) const override;
  std::unique_ptr<MotionCheck> make_check(const interpreter::Position& at) const override;
  void begin(const interpreter::Position& at) override;
  void begin_lengths(const ToolLengths& lengths) override;
  interpreter::EventSink& events() override { return builder_; }
  void set_lengths(const ToolLengths& lengths) override { builder_.set_lengths(lengths); }
  bool has_room() const override;
  void begin_probe(const interpreter::Probe& probe) override { builder_.begin_probe(probe); }
  bool input(int pin) const override;
  std::vector<std::pair<std::string, bool>> inputs() const override;
  std::optional<interpreter::SignalValue> signal(const std::string& name) override;
  bool drained() const override;
  Seconds buffered() const override;
  Seconds poll(Seconds elapsed, std::size_t max_actions) override;

  const OperatorPanel& panel() const override { return panel_; }
  /// A feed or rapid override of 0 is a hold. Releasing the emergency stop ends a fault.
  void set_panel(const OperatorPanel& panel) override;
  void hold() override;
  bool resume() override;
  bool needs_operator() const override;
  bool continue_unattended() override;
  void turn_handwheel(Seconds) override {}
  void abort() override;
  Result<void> home() override;
  bool stop_homing() override;
  Result<void> unlock() override;
  Result<void> jog(const Jog& jog) override;
  bool is_jogging() const override;
  void stop_jog() override;
  std::string jog_fault() const override;

  std::string notice() const override;
  MachineState state() const override;
  bool is_moving() const override;
  MachineStatus status() const override;
  std::optional<GivenAction::Point> rests_at() const override;
  PositionTrust position_trust() const override;

  static constexpr std::size_t kMaxActions = 1024;  ///< that are not sent yet
  static constexpr std::size_t kMaxLines = 16 * kMaxActions;

 protected:
  using Lock = std::unique_lock<std::mutex>;
  /// The link's side: the device is safe to use while the lock lives.
  Lock lock_device() const { return Lock(mutex_); }
  SteadyTime now() const { return clock_->steady_now(); }
  /// Sends the motion that may be sent, up to the first action that must wait for it.
  void pump(const Lock&);
  /// No action begins before the owner's next poll.
  void forbid(const Lock&) { is_allowed_ = false; }
  /// The owner has something to send: called without the mutex.
  virtual void wake() {}

 private:
  void set_active(bool is_active);
  bool stop_without_program();
  bool may_be_ahead(double seconds);
  bool is_over() const;
  bool may_begin() const;
  bool check_position(const Coordinates& expected, std::string_view reason = {});
  void announce(Lock& lock);
  bool deliver(Lock& lock);
  bool deliver_executed(Lock& lock);
  bool deliver_passed(Lock& lock);
  bool deliver_front(Lock& lock);
  bool deliver_motion(Lock& lock);
  bool deliver_command(Lock& lock);
  bool deliver_probe(Lock& lock);
  bool deliver_text(Lock& lock);
  bool deliver_stop(Lock& lock);
  void deliver_alarm(Lock& lock, const interpreter::Alarm& alarm);
  void report(Lock& lock, const Command& command);
  bool finish_front(Lock& lock);
  bool start_front(Lock& lock);
  void end_abort(Lock& lock);
  void discard();
  void take_made();
  void apply_overrides();
  void hold_by_override();
  void report_off();
  bool is_off() const { return is_off_due_ && device_.has_switched_off(); }
  MachineState current_state() const;
  Result<void> check_device() const;
  Result<void> begin_jog(const Jog& jog);
  template <class Call>
  void tell(Lock& lock, const Call& call);

  ExecutionSink& sink_;
  const std::shared_ptr<const Clock> clock_;
  const interpreter::MachineData stated_;
  std::unique_ptr<CommandWriter> (*const make_commands_)();
  QueueBuilder builder_;  ///< owner's thread only
  OperatorPanel panel_;   ///< owner's thread only
  mutable MotionCapabilities capabilities_;

  mutable std::mutex mutex_;  ///< guards all below
  Device& device_;
  std::deque<Action> queue_;
  std::size_t next_ = 0;       ///< the first action that is not completely sent
  std::size_t announced_ = 0;  ///< actions that the sink knows of, from the first: those before it
  double announced_seconds_ = 0;
  double queued_seconds_ = 0;
  std::size_t queued_lines_ = 0;
  struct Ahead {
    std::uint64_t serial = 0;
    double seconds = 0;
  };
  std::deque<Ahead> ahead_;  ///< motion that was sent and is not executed
  double seconds_ahead_ = 0;
  Coordinates expected_{};    ///< where the axes are when everything sent is executed
  bool is_active_ = false;    ///< a program has begun and is not over
  bool has_begun_ = false;    ///< the first line may be sent: the axes were where they should be
  bool is_released_ = false;  ///< the motion at the front may be sent, and all that follows it
  bool has_started_ = false;  ///< the front action was announced to the sink
  bool is_allowed_ = false;   ///< the owner lets actions begin
  bool is_single_block_ = false, is_emergency_ = false, is_aborting_ = false;
  bool is_override_hold_ = false;     ///< an override is 0: nothing begins
  bool is_held_by_override_ = false;  ///< and the device is held by nothing else
  bool is_off_due_ = false;           ///< a stop switches spindle and coolant off
  interpreter::OverrideInhibit inhibit_;
  MachineState stop_ = MachineState::Idle;
  interpreter::StopKind stopped_at_{};
  MachineStatus shown_;  ///< motion, tool, spindle, coolant
  interpreter::Origin origin_;
  std::uint64_t executed_ = 0;
};

}  // namespace dripline::machine::streamed
