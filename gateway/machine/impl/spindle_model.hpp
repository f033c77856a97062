#pragma once

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/machine_limits.hpp"

namespace dripline::machine::impl {

/// The speed of the spindle. It reaches its speed at once. Constant surface speed follows X (the
/// radius, mm) up to the program's and the machine's highest speed.
class SpindleModel {
 public:
  explicit SpindleModel(const SpindleLimits& limits) : limits_(limits) {}
  void set(const interpreter::Spindle& spindle) { spindle_ = spindle; }
  void stop() { spindle_ = {}; }
  const interpreter::Spindle& programmed() const { return spindle_; }
  bool is_turning() const;

  /// Revolutions per minute, 0 or more, with the tool at radius `x`.
  double rpm(double x, double override) const;
  /// The constant speed that makes as many revolutions from `x0` to `x1` as the changing one. With
  /// the spindle stopped: the machine's assumed speed.
  double mean_rpm(double x0, double x1) const;
  /// The highest possible speed now, at any override.
  double ceiling() const;
  bool is_counterclockwise() const {
    return spindle_.state == interpreter::SpindleState::Counterclockwise;
  }

 private:
  SpindleLimits limits_;
  interpreter::Spindle spindle_;
};

}  // namespace dripline::machine::impl
