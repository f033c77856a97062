#include "gateway/machine/streamed/machine_check.hpp"

#include <cmath>

namespace dripline::machine::streamed {
namespace {

using AxisData = interpreter::MachineData::AxisData;

bool is_same(double stated, double found) {
  constexpr double kRounding = 0.002;
  return std::fabs(stated - found) <= kRounding + 1e-4 * std::fabs(stated);
}

Result<void> check_axis(const AxisData& stated, std::size_t axis, const TextRules& rules) {
  const char name = letter_of(axis);
  if (!rules.has(axis))
    return fail(Errc::Conflict, "the setup has an axis {}, the machine has not", name);
  const double rate = rules.axes[axis]->max_rate;
  if (stated.max_rate && !is_same(*stated.max_rate, rate))
    return fail(Errc::Conflict, "the rate of {} is {:.6g} in the setup and {:.6g} on the machine{}",
                name, *stated.max_rate, rate, rules.axes[axis]->rate_setting);
  if (!stated.min) return {};
  const auto travel = rules.axes[axis]->travel;
  if (!travel)
    return fail(Errc::Conflict, "the setup has a travel of {}, the machine has none{}", name,
                rules.axes[axis]->travel_setting);
  if (is_same(*stated.min, travel->low) && is_same(*stated.max, travel->high)) return {};
  return fail(Errc::Conflict,
              "the travel of {} is {:.6g} to {:.6g} in the setup and {:.6g} to {:.6g} on the "
              "machine{}",
              name, *stated.min, *stated.max, travel->low, travel->high,
              rules.axes[axis]->travel_setting);
}

}  // namespace

Result<void> check_machine(const interpreter::MachineData& stated, const TextRules& rules) {
  for (std::size_t i = 0; i < stated.axes.size(); ++i) {
    if (!stated.axes[i]) continue;
    if (auto same = check_axis(*stated.axes[i], i, rules); !same) return same;
  }
  if (stated.max_rpm && !rules.max_rpm)
    return fail(Errc::Conflict, "max_rpm is {:.6g} in the setup, the machine states none{}",
                *stated.max_rpm, rules.max_rpm_setting);
  if (stated.max_rpm && !is_same(*stated.max_rpm, *rules.max_rpm))
    return fail(Errc::Conflict, "max_rpm is {:.6g} in the setup and {:.6g} on the machine{}",
                *stated.max_rpm, *rules.max_rpm, rules.max_rpm_setting);
  if (stated.homing == false && rules.homes)
    return fail(Errc::Conflict, "homing is off in the setup, the machine must be homed{}",
                rules.homing_setting);
  if (stated.homing == true && !rules.homes)
    return fail(Errc::Conflict, "homing is on in the setup and off on the machine{}",
                rules.homing_setting);
  return {};
}

}  // namespace dripline::machine::streamed
