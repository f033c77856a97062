#include "gateway/machine/machine_limits.hpp"

#include <cmath>

namespace dripline::machine {

using interpreter::Axis;

MachineLimits MachineLimits::lathe() {
  MachineLimits limits;
  limits.axis(Axis::X) =
      AxisLimits{.rapid_per_minute = 5'000, .feed_per_minute = 3'000, .acceleration = 1'000};
  limits.axis(Axis::Z) =
      AxisLimits{.rapid_per_minute = 10'000, .feed_per_minute = 5'000, .acceleration = 1'000};
  limits.spindle.max_rpm = 4'000;
  return limits;
}

MachineLimits MachineLimits::mill() {
  MachineLimits limits;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) limits.axis(axis) = AxisLimits{};
  for (const Axis axis : {Axis::A, Axis::B, Axis::C})
    limits.axis(axis) =
        AxisLimits{.rapid_per_minute = 7'200, .feed_per_minute = 3'600, .acceleration = 720};
  return limits;
}

namespace {

Result<void> check_axis(char name, const AxisLimits& axis) {
  if (!(axis.min <= axis.max))
    return fail(Errc::LimitExceeded, "axis {}: min {} is above max {}", name, axis.min, axis.max);
  const struct {
    const char* name;
    double value;
  } rates[] = {{"rapid_per_minute", axis.rapid_per_minute},
               {"feed_per_minute", axis.feed_per_minute},
               {"acceleration", axis.acceleration}};
  for (const auto& rate : rates)
    if (!(std::isfinite(rate.value) && rate.value > 0))
      return fail(Errc::LimitExceeded, "axis {}: {} is {}, must be above 0", name, rate.name,
                  rate.value);
  return {};
}

}  // namespace

Result<void> check(const MachineLimits& limits) {
  static constexpr char kNames[] = "XYZABCUVW";
  bool has_axis = false;
  for (std::size_t i = 0; i < limits.axes.size(); ++i) {
    if (!limits.axes[i]) continue;
    has_axis = true;
    if (auto checked = check_axis(kNames[i], *limits.axes[i]); !checked) return checked;
  }
  if (!has_axis) return fail(Errc::LimitExceeded, "the machine has no axis");
  if (!(std::isfinite(limits.spindle.max_rpm) && limits.spindle.max_rpm > 0))
    return fail(Errc::LimitExceeded, "spindle: max_rpm is {}, must be above 0",
                limits.spindle.max_rpm);
  if (!(limits.spindle.assumed_rpm >= 0 && limits.spindle.assumed_rpm <= limits.spindle.max_rpm))
    return fail(Errc::LimitExceeded, "spindle: assumed_rpm is {}, must be 0 to {}",
                limits.spindle.assumed_rpm, limits.spindle.max_rpm);
  if (!(std::isfinite(limits.corner_deviation) && limits.corner_deviation >= 0))
    return fail(Errc::LimitExceeded, "corner_deviation is {}, must be 0 or more",
                limits.corner_deviation);
  return {};
}

}  // namespace dripline::machine
