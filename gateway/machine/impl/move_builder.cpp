#include "gateway/machine/impl/move_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dripline::machine::impl {

using interpreter::kAxisCount;

namespace {

constexpr char kAxisNames[] = "XYZABCUVW";
constexpr double kTravelTolerance = 1e-6;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

double dot(const Coordinates& a, const Coordinates& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kAxisCount; ++i) sum += a[i] * b[i];
  return sum;
}

void make_unit(Coordinates& direction) {
  const double square = dot(direction, direction);
  if (std::fabs(square - 1) < 1e-12) return;
  const double scale = square > 0 ? 1 / std::sqrt(square) : 0;
  for (double& part : direction) part *= scale;
}

}  // namespace

Refusal MoveBuilder::beyond(std::size_t axis, double value, double limit) const {
  const auto which = static_cast<interpreter::Axis>(axis);
  const bool is_doubled = axis == 0 && display_.x_is_diameter;
  return {"MCH0001", fmt::format("axis {}{} would go to {} {}, its travel ends at {}",
                                 interpreter::letter(which), is_doubled ? " (diameter)" : "",
                                 interpreter::shown_axis_number(which, value, display_),
                                 interpreter::shown_unit(which, display_.units),
                                 interpreter::shown_axis_number(which, limit, display_))};
}

std::optional<Refusal> MoveBuilder::build(const MoveTask& task, const SpindleModel& spindle,
                                          Move& move) {
  if (!std::isfinite(task.path.length)) return Refusal{"MCH0006", "the move has no finite length"};
  if (auto refusal = check_travel(task.path)) return refusal;
  move.path = task.path;
  move.pace = task.pace;
  set_axis_limits(move);
  if (auto refusal = set_speed(task, spindle, move)) return refusal;
  set_corner(move);
  return std::nullopt;
}

std::optional<Refusal> MoveBuilder::check_travel(const Path& path) const {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (path.share(i) == 0) continue;
    const auto& axis = limits_.axes[i];
    if (!axis) return Refusal{"MCH0002", fmt::format("this machine has no axis {}", kAxisNames[i])};
    const Range range = path.range(i);
    // A return from outside is allowed, so on a line only the end point is significant.
    const double low = path.is_arc() ? range.low : path.to[i];
    const double high = path.is_arc() ? range.high : path.to[i];
    if (low < axis->min - kTravelTolerance) return beyond(i, low, axis->min);
    if (high > axis->max + kTravelTolerance) return beyond(i, high, axis->max);
  }
  return std::nullopt;
}

void MoveBuilder::set_axis_limits(Move& move) const {
  move.ceiling = move.acceleration = kUnlimited;
  const bool at_rapid = move.pace == Pace::Rapid || move.pace == Pace::Thread;
  if (!at_rapid) move.ceiling = limits_.fastest_feed_per_minute / 60;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const double share = move.path.share(i);
    if (share == 0) continue;
    const AxisLimits& axis = *limits_.axes[i];
    const double per_minute = at_rapid ? axis.rapid_per_minute : axis.feed_per_minute;
    move.ceiling = std::min(move.ceiling, per_minute / 60 / share);
    move.acceleration = std::min(move.acceleration, axis.acceleration / share);
  }
  if (!move.path.is_arc()) return;
  const Circle& circle = move.path.circle;
  const double inward =
      std::min(limits_.axes[circle.first]->acceleration, limits_.axes[circle.second]->acceleration);
  const double radius = std::min(circle.radius, circle.radius + circle.radius_change);
  const double turning = std::sqrt(inward * std::max(radius, 1e-6));
  move.ceiling = std::min(move.ceiling, turning / move.path.share(circle.first));
}

std::optional<Refusal> MoveBuilder::set_speed(const MoveTask& task, const SpindleModel& spindle,
                                              Move& move) const {
  if (task.pace == Pace::Rapid) {
    move.speed = move.ceiling;
    return std::nullopt;
  }
  double per_revolution = 0;
  if (task.pace == Pace::Thread) {
    double share = 0;
    for (std::size_t i = 0; i < kAxisCount; ++i) share = std::max(share, task.path.share(i));
    per_revolution = task.lead.mm() / share;
  } else if (task.feed.per() == Feed::Per::Revolution) {
    move.pace = Pace::FeedPerRevolution;
    per_revolution = task.feed.length().mm();
  } else {
    move.speed = task.feed.per() == Feed::Per::Move
                     ? task.feed.moves_per_minute() * task.path.length / 60
                     : task.feed.length().mm() / 60;
    if (move.speed > 0) return std::nullopt;
    return Refusal{"MCH0003", "the feed is zero, the move would never end"};
  }
  const double rpm = spindle.mean_rpm(task.path.from[0], task.path.to[0]);
  if (!(rpm > 0)) return Refusal{"MCH0004", "a feed per revolution with the spindle stopped"};
  if (!(per_revolution > 0)) return Refusal{"MCH0003", "the feed per revolution is zero"};
  move.speed = per_revolution * rpm / 60;
  move.spindle_headroom = std::max(1.0, spindle.ceiling() / rpm);
  if (task.pace == Pace::Thread && move.speed > move.ceiling)
    return Refusal{
        "MCH0007",
        fmt::format("the thread needs {}/min, the axes reach {}",
                    interpreter::shown_length(Length::mm(move.speed * 60), display_.units),
                    interpreter::shown_number(Length::mm(move.ceiling * 60), display_.units))};
  return std::nullopt;
}

void MoveBuilder::set_corner(Move& move) {
  const double length = move.path.length;
  Coordinates begins = move.path.direction_at_start();
  make_unit(begins);
  move.corner_square = 0;
  if (has_direction_) {
    const double along = dot(direction_, begins);  // cosine of the change of direction
    const double acceleration = std::min(acceleration_, move.acceleration);
    move.corner_square = kUnlimited;
    if (along < 1 - 1e-12) {
      // The circle that is tangent to both moves and deviates from the corner by the allowed
      // distance.
      const double half = std::sqrt(std::max(0.0, (1 + along) / 2));
      move.corner_square = acceleration * limits_.corner_deviation * half / (1 - half);
      // Many short moves make a curve: its radius is length over change of direction.
      const double turn = std::acos(std::clamp(along, -1.0, 1.0));
      const double radius = std::min(length_, length) / turn;
      move.corner_square = std::min(move.corner_square, acceleration * radius);
    }
  }
  direction_ = begins;
  if (move.path.is_arc()) {
    direction_ = move.path.direction_at_end();
    make_unit(direction_);
  }
  has_direction_ = true;
  acceleration_ = move.acceleration;
  length_ = length;
}

}  // namespace dripline::machine::impl
