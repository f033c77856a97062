#include "gateway/machine/impl/executor.hpp"

#include <algorithm>

namespace dripline::machine::impl {

void Motion::start(const Move& move, double entry, const MotionGoal& goal) {
  move_ = &move;
  begun_at_ = 0;
  plan(entry, goal);
}

void Motion::change(const MotionGoal& goal) {
  const double now = speed();
  begun_at_ = std::min(distance(), move_->path.length);
  plan(now, goal);
}

void Motion::rest() {
  begun_at_ = std::min(distance(), move_->path.length);
  plan(0, {});
}

void Motion::plan(double entry, const MotionGoal& goal) {
  time_ = 0;
  profile_ = Profile({.length = move_->path.length - begun_at_,
                      .entry = entry,
                      .cruise = goal.cruise,
                      .exit = goal.exit,
                      .acceleration = move_->acceleration});
}

}  // namespace dripline::machine::impl
