#pragma once

#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/machine/execution_sink.hpp"
#include "gateway/machine/impl/action.hpp"
#include "gateway/machine/impl/action_queue.hpp"
#include "gateway/machine/impl/motion_queue_builder.hpp"
#include "gateway/machine/impl/profile.hpp"
#include "gateway/machine/machine_limits.hpp"
#include "gateway/machine/machine_status.hpp"
#include "gateway/machine/motion_backend.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine::impl {

/// The goal of a move from now on; speeds in mm (or degrees) per second.
struct MotionGoal {
  double cruise = 0;  ///< 0: come to rest
  double exit = 0;
};

/// One move in progress. Time is kept from the last change of goal, so the position at a
/// time does not depend on the steps to it.
class Motion {
 public:
  bool is_active() const { return move_ != nullptr; }
  const Move& move() const { return *move_; }
  /// `move` must stay where it is until stop().
  void start(const Move& move, double entry, const MotionGoal& goal);
  void change(const MotionGoal& goal);
  /// The axes rest at the distance reached.
  void rest();
  void stop() { move_ = nullptr; }

  double left() const { return profile_.duration() - time_; }
  void pass(double seconds) { time_ += seconds; }
  void pass_all() { time_ = profile_.duration(); }
  /// After all time has passed: at the end of the move, or at rest before it.
  bool reaches_end() const { return profile_.reaches_end(); }
  double exit_speed() const { return profile_.exit_speed(); }

  double distance() const { return begun_at_ + profile_.distance_at(time_); }
  double speed() const { return profile_.speed_at(time_); }

 private:
  void plan(double entry, const MotionGoal& goal);

  const Move* move_ = nullptr;
  Profile profile_;
  double begun_at_ = 0;  ///< distance where the profile begins
  double time_ = 0;
};

/// Look-ahead: the highest speed at the end of each queued move from which everything after it can
/// still be obeyed (corners, slower moves, standstills, the end of what is queued).
///
/// One pass from the back of a window to the front. An exit speed that a corner or feed decides,
/// and not the window's end, is final: more moves cannot change it. So a move is planned a few
/// times at most, for any length of the queue, and the result does not depend on when it was
/// planned.
class Planner {
 public:
  /// The front of the queue is about to start, or moves already: corrects its exit speed.
  void ensure(ActionQueue& queue, const OperatorPanel& panel);
  /// Overrides or switches have changed.
  void invalidate() { final_until_ = 0, planned_next_ = 0; }

  static constexpr std::size_t kWindow = 1024;

 private:
  void plan(ActionQueue& queue, const OperatorPanel& panel);

  std::uint64_t final_until_ = 0;    ///< exits of actions before this number are final
  std::uint64_t planned_until_ = 0;  ///< the window's end
  std::uint64_t planned_next_ = 0;   ///< the queue's next() then
};

/// Executes the queue in machine time: starts the front action, lets time pass over it, reports it
/// and takes the next. Zero-time actions are executed between the moves without stopping them.
class Executor {
 public:
  struct Parts {
    const MachineLimits& limits;
    const interpreter::Workpiece& workpiece;
    ActionQueue& queue;
    MotionQueueBuilder& queue_builder;
    ExecutionSink& sink;
  };
  explicit Executor(const Parts& parts);

  void begin(const interpreter::Position& at);
  /// Spindle, coolant and what is shown of the tool stay.
  void begin_next(const interpreter::Position& at);
  double advance(double by, std::size_t max_actions);

  const OperatorPanel& panel() const { return panel_; }
  void set_panel(const OperatorPanel& panel);
  void hold();
  bool resume();
  void abort();
  void turn_handwheel(double seconds);
  /// See MotionBackend.
  Result<void> jog(const Jog& jog);
  bool is_jogging() const { return is_jogging_; }
  void stop_jog();

  MachineState state() const;
  bool is_moving() const;
  MachineStatus status() const;
  double buffered() const;

 private:
  double pass(double by, std::size_t max_actions);
  bool is_driven_by_hand() const;
  bool rests_by_hand() const;
  void leave_handwheel();
  bool pass_dwell(double by, double& used);
  bool may_start() const;
  bool continues_regardless() const;
  bool delays_hold(const Lock& lock) const;
  bool must_rest(const Lock& lock) const;
  void ask_for_records();
  bool is_over() const;
  bool start_front();
  void enter(const Action& action);
  bool skips(const Action& action) const;
  void start(const Move& move);
  void start_probe();
  void end_jog();
  /// The present move is one of the queue: no probe's, no jog.
  bool is_of_queue() const {
    return motion_.is_active() && &motion_.move() != &probe_move_ && !is_jogging_;
  }
  void finish_move();
  void finish_probe();
  void finish_action();
  void report(const Action& action);
  void report_text(const interpreter::Origin& origin, const Text& text);
  void report_alarm(const interpreter::Origin& origin);
  void report_stop(const interpreter::Stop& stop);
  void show(const Move& move);
  void show(const interpreter::ToolChange& tool);
  void discard();
  void press_emergency_stop();
  void set_spindle(const interpreter::Spindle& spindle);
  void stop_spindle();
  void return_spindle();
  /// The rest of an aborted program is dropped, and the abort reported, only with the emergency
  /// stop released.
  bool may_discard() const { return is_aborting_ && !panel_.emergency_stop; }

  MotionGoal goal(const Move& move) const;
  void look_ahead_again();
  void plan_motion_again();
  double speed() const;
  Coordinates position() const;

  const MachineLimits& limits_;
  const interpreter::Workpiece& workpiece_;
  ActionQueue& queue_;
  MotionQueueBuilder& queue_builder_;
  ExecutionSink& sink_;
  Planner planner_;
  OperatorPanel panel_;
  SpindleModel spindle_;
  /// As programmed, in a dry run that it does not turn in; it runs again when a motion begins
  /// after that.
  std::optional<interpreter::Spindle> withheld_spindle_;

  Motion motion_;  ///< the present move, if any
  Move probe_move_;
  Move jog_move_;
  bool is_jogging_ = false;       ///< from its beginning until the axes rest
  bool is_jog_stopping_ = false;  ///< they slow down before its end
  bool is_dwelling_ = false;      ///< the front of the queue is a wait that has begun
  bool dwell_follows_spindle_ = false;
  double dwell_left_ = 0;       ///< at 100 % spindle, where it follows that
  double speed_ = 0;            ///< between two moves
  Coordinates at_{};            ///< between two moves
  interpreter::Position axes_;  ///< marks the axes that a program has named

  bool is_held_ = false, is_aborting_ = false;
  bool is_emergency_ = false;     ///< the abort is an emergency stop: nothing is switched on
  bool lacks_records_ = false;    ///< the axes run, and what was reported cannot be written
  Lock lock_;                     ///< of the action begun last
  bool hold_waits_ = false;       ///< for the end of moves that cannot be held
  bool skips_tap_ = false;        ///< this tapping cycle is not done by handwheel
  double handwheel_seconds_ = 0;  ///< turned, but not passed yet
  MachineState stop_ = MachineState::Idle;  ///< Idle: no stop
  interpreter::StopKind stopped_at_{};
  MachineStatus shown_;  ///< only motion, tool and coolant, as executed last
  interpreter::Origin origin_;
  std::uint64_t executed_ = 0;
};

}  // namespace dripline::machine::impl
