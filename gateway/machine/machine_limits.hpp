#pragma once

#include <array>
#include <limits>
#include <optional>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine {

/// What one axis can do. Linear axes: millimeters (a lathe's X in radius); rotary axes: degrees.
struct AxisLimits {
  double min = -std::numeric_limits<double>::infinity();  ///< travel, both ends allowed
  double max = std::numeric_limits<double>::infinity();
  double rapid_per_minute = 10'000;
  double feed_per_minute = 5'000;  ///< the highest feed, also when more is programmed
  double acceleration = 1'000;     ///< per second squared
};

struct SpindleLimits {
  double max_rpm = 6'000;
  /// Used for feed per revolution and threads while the spindle is stopped; 0: that is an alarm.
  double assumed_rpm = 0;
};

/// The machine as configured. Value type.
struct MachineLimits {
  std::array<std::optional<AxisLimits>, interpreter::kAxisCount> axes;  ///< absent: no such axis
  SpindleLimits spindle;
  /// A corner is passed at the speed of the circle that deviates from it by this distance (mm); the
  /// path itself stays exact. 0: full stop at every corner.
  double corner_deviation = 0.02;
  /// Path feed per minute that no override exceeds, where the control has such a limit.
  double fastest_feed_per_minute = std::numeric_limits<double>::infinity();
  bool waits_at_tool_change = false;  ///< a tool change stop waits for resume, as a program stop

  const std::optional<AxisLimits>& axis(interpreter::Axis axis) const {
    return axes[static_cast<std::size_t>(axis)];
  }
  std::optional<AxisLimits>& axis(interpreter::Axis axis) {
    return axes[static_cast<std::size_t>(axis)];
  }

  /// Two axes, X (radius) and Z, ordinary speeds, no travel limits.
  static MachineLimits lathe();
  /// X, Y, Z and the rotary A, B, C.
  static MachineLimits mill();
};

/// Errors: LimitExceeded, naming the axis and the value that cannot be (a speed or acceleration
/// that is not positive and finite, min above max, no axis at all).
Result<void> check(const MachineLimits& limits);

}  // namespace dripline::machine
