#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "gateway/interpreter/core/machine_data.hpp"
#include "gateway/machine/grbl/board_session.hpp"
#include "gateway/machine/grbl/motion_queue.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::machine::grbl {

class BoardLink;

/// A board of the Grbl 1.1 class (Grbl, grblHAL) as what moves the axes: the program's blocks
/// become lines that are streamed ahead; whatever is not motion waits until the motion before it is
/// executed. The README names what it cannot do, and its alarms.
///
/// The owner's functions are those of MotionBackend, on one thread. The line's functions are called
/// by another (BoardLink, or a test); a mutex is between them. The sink is called without it.
class GrblMachine final : public MotionBackend {
 public:
  struct Parts {
    ExecutionSink& sink;
    std::shared_ptr<const Clock> clock;
    interpreter::MachineData machine = {};  ///< what the setup states; the board must agree
    SessionLimits limits = {};
  };
  explicit GrblMachine(Parts parts);
  ~GrblMachine() override;

  /// Connects to the board at `address` and keeps the connection (see board_link.hpp).
  void connect(const std::string& address);

  // -- the line's side, any thread ----------------------------------------------------------------
  void line_opened();
  void line_lost(const std::string& reason);
  /// Takes what came; returns what must be written. To be called at least every 10 ms.
  BoardOutput exchange(std::span<const std::byte> bytes);
  /// The line is about to be closed in the midst of a program: the board is held.
  void line_closing();
  /// Why the line should be opened again; empty: it should not.
  std::string reopen_reason() const;
  bool may_open() const;

  // -- the owner's side ---------------------------------------------------------------------------
  const MotionCapabilities& capabilities() const override;
  /// Errors: Busy (no board, an alarm), Conflict (the board is another machine than the setup
  /// states, the axes are elsewhere), Unsupported.
  Result<void> check_begin(const interpreter::Position& at) const override;
  void begin(const interpreter::Position& at) override;
  interpreter::EventSink& events() override { return builder_; }
  bool has_room() const override;
  void begin_probe(const interpreter::Probe& probe) override { builder_.begin_probe(probe); }
  /// Boards of this class report no inputs.
  bool input(int) const override { return false; }
  bool drained() const override;
  Seconds buffered() const override;
  Seconds poll(Seconds elapsed, std::size_t max_actions) override;

  const OperatorPanel& panel() const override { return panel_; }
  /// A feed override under 10 % and a rapid override under 25 % are 0, a hold: the board has none
  /// that is lower. Releasing the emergency stop ends a fault of the board: it is reset and
  /// identified again.
  void set_panel(const OperatorPanel& panel) override;
  void hold() override;
  bool resume() override;
  void turn_handwheel(Seconds) override {}
  void abort() override;
  Result<void> home() override;    ///< $H
  Result<void> unlock() override;  ///< $X

  std::string notice() const override;
  MachineState state() const override;
  bool is_moving() const override;
  MachineStatus status() const override;

  static constexpr std::size_t kMaxActions = 1024;  ///< that are not sent yet

 private:
  using Lock = std::unique_lock<std::mutex>;
  enum class Preamble : std::uint8_t { None, Sent, Asked, Done };

  bool is_over() const;
  bool may_begin() const;
  void pump();
  bool prepare();
  bool check_position(const Coordinates& expected);
  bool deliver(Lock& lock);
  bool deliver_front(Lock& lock);
  bool deliver_motion(Lock& lock);
  bool deliver_command(Lock& lock);
  bool deliver_probe(Lock& lock);
  bool deliver_text(Lock& lock);
  bool deliver_stop(Lock& lock);
  void deliver_alarm(Lock& lock, interpreter::Alarm alarm);
  bool finish_front(Lock& lock);
  bool start_front(Lock& lock);
  bool end_abort(Lock& lock);
  void discard();
  void take_made();
  void apply_overrides();
  void hold_by_override(SteadyTime now);
  void report_off();
  MachineState current_state() const;
  void wake();

  ExecutionSink& sink_;
  const std::shared_ptr<const Clock> clock_;
  const interpreter::MachineData stated_;
  QueueBuilder builder_;  ///< owner's thread only
  OperatorPanel panel_;   ///< owner's thread only
  mutable MotionCapabilities capabilities_;

  mutable std::mutex mutex_;  ///< guards all below
  BoardSession session_;
  std::deque<Action> queue_;
  std::size_t next_ = 0;  ///< the first action that is not completely sent
  double queued_seconds_ = 0;
  Preamble preamble_ = Preamble::None;
  std::uint64_t preamble_resets_ = 0;
  Coordinates expected_{};    ///< where the axes are when everything sent is executed
  bool is_released_ = false;  ///< the motion at the front may be sent, and all that follows it
  bool has_started_ = false;  ///< the front action was announced to the sink
  bool is_allowed_ = false;   ///< the owner lets actions begin
  bool is_single_block_ = false, is_emergency_ = false, is_aborting_ = false;
  bool is_override_hold_ = false;           ///< an override is 0: nothing begins
  bool is_board_held_by_override_ = false;  ///< and by nothing else
  interpreter::OverrideInhibit inhibit_;
  MachineState stop_ = MachineState::Idle;
  interpreter::StopKind stopped_at_{};
  interpreter::Position axes_;  ///< marks the board's axes
  MachineStatus shown_;         ///< motion, tool, spindle, coolant
  interpreter::Origin origin_;
  std::uint64_t executed_ = 0;

  std::unique_ptr<BoardLink> link_;  ///< last: its thread ends first
};

/// Marks the first `axes` axes.
interpreter::Position position_of(const Coordinates& point, std::size_t axes);

}  // namespace dripline::machine::grbl
