#include "gateway/machine/impl/profile.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::machine::impl {

namespace {

/// Squares of speeds that differ by less are the same: so much may be lost where a move is planned
/// again halfway, and an exit at 0 must stay exactly 0.
constexpr double kSameSquare = 1e-9;

double square(double x) {
  return x * x;
}

}  // namespace

Profile::Profile(const ProfileTask& task) : entry_(task.entry), acceleration_(task.acceleration) {
  const double reach = 2 * task.acceleration * task.length;  // change of the speed's square
  if (task.cruise <= 0 && square(task.entry) < reach) {
    rest(task);
    return;
  }
  const double exit = std::min(task.exit, std::max(task.cruise, 0.0));
  if (square(task.entry) - square(exit) > reach + kSameSquare * (square(task.entry) + 1)) {
    brake_all_the_way(task);
    return;
  }
  exit_ = exit;
  plan(task, task.cruise);
}

void Profile::rest(const ProfileTask& task) {
  top_ = task.entry;
  brake_ = task.entry / task.acceleration;
  exit_ = 0;
  reaches_end_ = false;
}

void Profile::brake_all_the_way(const ProfileTask& task) {
  top_ = task.entry;
  exit_ = std::sqrt(std::max(0.0, square(task.entry) - 2 * task.acceleration * task.length));
  brake_ = (top_ - exit_) / task.acceleration;
}

void Profile::plan(const ProfileTask& task, double cruise) {
  const double a = task.acceleration;
  const double reach = 2 * a * task.length;
  if (entry_ > cruise) {  // too fast already: the first ramp goes down
    top_ = cruise;
  } else {
    const double peak = (reach + square(entry_) + square(exit_)) / 2;
    top_ = std::max(entry_, std::min(cruise, std::sqrt(peak)));
    if (top_ < exit_) top_ = exit_ = std::sqrt(square(entry_) + reach);
  }
  const double ramp_length = std::fabs(square(top_) - square(entry_)) / (2 * a);
  const double brake_length = std::max(0.0, square(top_) - square(exit_)) / (2 * a);
  const double left = task.length - ramp_length - brake_length;
  ramp_ = std::fabs(top_ - entry_) / a;
  cruise_ = left > 0 && top_ > 0 ? left / top_ : 0;
  brake_ = std::max(0.0, top_ - exit_) / a;
}

double Profile::distance_at(double time) const {
  const double ramp = std::min(time, ramp_);
  const double slope = top_ >= entry_ ? acceleration_ : -acceleration_;
  double distance = entry_ * ramp + slope * ramp * ramp / 2;
  if (time <= ramp_) return distance;
  const double cruise = std::min(time - ramp_, cruise_);
  distance += top_ * cruise;
  if (time <= ramp_ + cruise_) return distance;
  const double brake = std::min(time - ramp_ - cruise_, brake_);
  return distance + top_ * brake - acceleration_ * brake * brake / 2;
}

double Profile::speed_at(double time) const {
  if (time < ramp_) return entry_ + (top_ >= entry_ ? acceleration_ : -acceleration_) * time;
  if (time < ramp_ + cruise_) return top_;
  if (time >= duration()) return exit_;
  return std::max(exit_, top_ - acceleration_ * (time - ramp_ - cruise_));
}

}  // namespace dripline::machine::impl
