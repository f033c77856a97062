#pragma once

#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/machine/execution_sink.hpp"
#include "gateway/machine/impl/motion.hpp"
#include "gateway/machine/impl/planner.hpp"
#include "gateway/machine/impl/motion_queue_builder.hpp"
#include "gateway/machine/machine_limits.hpp"
#include "gateway/machine/machine_status.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine::impl {

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
  double advance(double by, std::size_t max_actions);

  const OperatorPanel& panel() const { return panel_; }
  void set_panel(const OperatorPanel& panel);
  void hold();
  bool resume();
  void abort();
  void turn_handwheel(double seconds);

  MachineState state() const;
  bool is_moving() const;
  MachineStatus status() const;
  double buffered() const;

 private:
  double pass(double by, std::size_t max_actions);
  bool is_driven_by_hand() const;
  bool pass_dwell(double by, double& used);
  bool may_start() const;
  bool continues_regardless() const;
  bool delays_hold(const Lock& lock) const;
  bool is_over() const;
  void start_front();
  void enter(const Action& action);
  bool skips(const Action& action) const;
  void start(const Move& move);
  void start_probe();
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

  Motion motion_;  ///< the present move, if any
  Move probe_move_;
  bool is_dwelling_ = false;  ///< the front of the queue is a wait that has begun
  bool dwell_follows_spindle_ = false;
  double dwell_left_ = 0;       ///< at 100 % spindle, where it follows that
  double speed_ = 0;            ///< between two moves
  Coordinates at_{};            ///< between two moves
  interpreter::Position axes_;  ///< marks the axes that a program has named

  bool is_held_ = false, is_aborting_ = false;
  bool is_emergency_ = false;     ///< the abort is an emergency stop: nothing is switched on
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
