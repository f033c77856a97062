#pragma once

#include "gateway/machine/impl/action.hpp"
#include "gateway/machine/impl/profile.hpp"

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

}  // namespace dripline::machine::impl
