#include "gateway/machine/impl/spindle_model.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::machine::impl {

using interpreter::SpindleState;

bool SpindleModel::is_turning() const {
  return interpreter::is_turning(spindle_.state);
}

double SpindleModel::ceiling() const {
  const double programmed = spindle_.max_revolutions.value_or(limits_.max_rpm);
  return std::max(0.0, std::min(limits_.max_rpm, programmed));
}

double SpindleModel::rpm(double x, double override) const {
  if (!is_turning()) return 0;
  double wanted = spindle_.revolutions_per_minute;
  if (spindle_.surface_speed) {
    const double circumference = 2 * Angle::kPi * std::fabs(x);
    wanted = circumference > 0 ? spindle_.surface_speed->mm() / circumference : ceiling();
  }
  return std::clamp(wanted * override, 0.0, ceiling());
}

double SpindleModel::mean_rpm(double x0, double x1) const {
  if (!is_turning()) return limits_.assumed_rpm;
  if (!spindle_.surface_speed || x0 == x1) {
    const double speed = rpm(x0, 1);
    return speed > 0 ? speed : limits_.assumed_rpm;
  }
  if (!(spindle_.surface_speed->mm() > 0) || ceiling() <= 0) return limits_.assumed_rpm;
  // Minutes per revolution: proportional to the radius, but not below the shortest. Their mean
  // over the path, by the integral from the center to either end.
  const double slope = 2 * Angle::kPi / spindle_.surface_speed->mm();
  const double shortest = 1 / ceiling();
  const double bend = shortest / slope;
  const auto integral = [&](double x) {
    const double r = std::fabs(x);
    return r <= bend ? shortest * r : shortest * bend + slope * (r * r - bend * bend) / 2;
  };
  const bool crosses = (x0 < 0) != (x1 < 0);
  const double sum = crosses ? integral(x0) + integral(x1) : std::fabs(integral(x1) - integral(x0));
  return std::fabs(x1 - x0) / sum;
}

}  // namespace dripline::machine::impl
