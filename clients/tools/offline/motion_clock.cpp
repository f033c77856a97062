#include "clients/tools/offline/motion_clock.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::interpreter {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
/// Of axes that state none: so high that no ramp is seen.
constexpr double kInstant = 1e12;

double product(const TimedMove::Coordinates& a, const TimedMove::Coordinates& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double square(double value) {
  return value * value;
}

}  // namespace

bool MotionClock::is_stated(const MachineData& machine) {
  return std::ranges::any_of(machine.axes,
                             [](const auto& axis) { return axis && axis->acceleration; });
}

MotionClock::MotionClock(const MachineData& machine, OnTimed on_timed)
    : on_timed_(std::move(on_timed)) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto& axis = machine.axes[i];
    acceleration_[i] = axis ? axis->acceleration.value_or(kInstant) : kInstant;
    rate_[i] = axis && axis->max_rate ? *axis->max_rate / kSecondsPerMinute : kUnlimited;
  }
}

void MotionClock::add(const TimedMove& move) {
  if (!(move.length > 0) || !(move.speed > 0)) return;
  Item item{.tag = move.tag, .length = move.length, .speed = move.speed, .acceleration = kInstant};
  bool has_rates = move.is_rapid;
  for (std::size_t i = 0; i < kAxisCount; ++i)
    has_rates &= !(move.share[i] > 0 && rate_[i] == kUnlimited);
  if (has_rates) item.speed = kUnlimited;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (move.share[i] == 0) continue;
    item.speed = std::min(item.speed, rate_[i] / move.share[i]);
    item.acceleration = std::min(item.acceleration, acceleration_[i] / move.share[i]);
  }
  if (move.radius > 0) {
    const auto first = static_cast<std::size_t>(move.first);
    const double inward =
        std::min(acceleration_[first], acceleration_[static_cast<std::size_t>(move.second)]);
    item.speed = std::min(item.speed, std::sqrt(inward * move.radius) / move.share[first]);
  }
  item.corner_square = corner_square(move, item.acceleration);
  direction_ = move.ends;
  has_direction_ = true;
  last_acceleration_ = item.acceleration;
  last_length_ = item.length;
  queue_.push_back(item);
  if (queue_.size() < kWindow) return;
  // The window may end in the middle of a curve: its first half is planned well enough.
  plan();
  finish(kWindow / 2);
}

/// The circle that is tangent to both moves and leaves the corner by the deviation; of a curve of
/// short moves also by its own radius.
double MotionClock::corner_square(const TimedMove& move, double acceleration) const {
  if (!has_direction_) return 0;
  const double lengths =
      std::sqrt(product(direction_, direction_) * product(move.begins, move.begins));
  const double along = lengths > 0 ? product(direction_, move.begins) / lengths : -1;
  if (along >= 1 - 1e-12) return kUnlimited;
  const double least = std::min(last_acceleration_, acceleration);
  const double half = std::sqrt(std::max(0.0, (1 + along) / 2));
  const double radius = std::min(last_length_, move.length) / std::acos(std::clamp(along, -1., 1.));
  return least * std::min(kCornerDeviation * half / (1 - half), radius);
}

void MotionClock::stop() {
  plan();
  finish(queue_.size());
  has_direction_ = false;
  entry_ = 0;
}

/// From the back: with which speed a move may end so that all after it can be obeyed.
void MotionClock::plan() {
  double allowed = 0;
  for (auto item = queue_.rbegin(); item != queue_.rend(); ++item) {
    const double wanted = square(item->speed);
    item->exit_square = std::min(allowed, wanted);
    const double reach = item->exit_square + 2 * item->acceleration * item->length;
    allowed = std::min({item->corner_square, wanted, reach});
  }
}

void MotionClock::finish(std::size_t count) {
  for (; count > 0; --count) {
    const Item item = queue_.front();
    queue_.pop_front();
    on_timed_(item.tag, seconds_of(item));
  }
}

/// A ramp to the speed, the speed, a ramp to the exit.
double MotionClock::seconds_of(const Item& item) {
  const double a = item.acceleration;
  const double entry = std::min(entry_, item.speed);
  const double reach = 2 * a * item.length;
  const double exit = std::sqrt(std::min(item.exit_square, square(entry) + reach));
  const double top = std::max(
      {entry, exit, std::min(item.speed, std::sqrt((reach + square(entry) + square(exit)) / 2))});
  const double ramps = (2 * square(top) - square(entry) - square(exit)) / (2 * a);
  const double cruise = std::max(0.0, item.length - ramps);
  entry_ = exit;
  return (2 * top - entry - exit) / a + cruise / top;
}

}  // namespace dripline::interpreter
