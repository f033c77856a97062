#include "gateway/app/motion_choice.hpp"

#include <algorithm>
#include <array>

#include "gateway/machine/simulated_machine.hpp"

namespace dripline::gateway {
namespace {

machine::MachineLimits limits_of(const interpreter::Dialect& control) {
  const bool is_lathe = control.machine == interpreter::MachineKind::Lathe;
  auto limits = is_lathe ? machine::MachineLimits::lathe() : machine::MachineLimits::mill();
  limits.waits_at_tool_change = control.waits_at_tool_change;
  if (control.feed_override_switch.fastest)
    limits.fastest_feed_per_minute = control.feed_override_switch.fastest->mm();
  return limits;
}

Result<machine::MotionFactory> simulated(const interpreter::Dialect& control,
                                         const interpreter::Workpiece& workpiece) {
  return [limits = limits_of(control), workpiece](machine::ExecutionSink& sink) {
    return std::make_unique<machine::SimulatedMachine>(limits, workpiece, sink);
  };
}

struct MotionRow {
  std::string_view name;
  Result<machine::MotionFactory> (*make)(const interpreter::Dialect&,
                                         const interpreter::Workpiece&);
};
constexpr std::array kRows{
    MotionRow{"simulated", simulated},
};

Result<const MotionRow*> find_row(std::string_view name) {
  const auto* row = std::ranges::find(kRows, name, &MotionRow::name);
  if (row == kRows.end())
    return fail(Errc::NotFound, "motion '{}' is not known: {}", name, motion_names());
  return row;
}

}  // namespace

std::string motion_names() {
  std::string names;
  for (const MotionRow& row : kRows) {
    if (!names.empty()) names += ", ";
    names += row.name;
  }
  return names;
}

Result<void> check_motion(std::string_view name) {
  const auto row = find_row(name);
  if (!row) return fail(row.error());
  return {};
}

Result<machine::MotionFactory> make_motion(std::string_view name,
                                           const interpreter::Dialect& control,
                                           const interpreter::Workpiece& workpiece) {
  const auto row = find_row(name);
  if (!row) return fail(row.error());
  return (*row)->make(control, workpiece);
}

}  // namespace dripline::gateway
