#include "gateway/app/motion_choice.hpp"

#include <algorithm>
#include <array>

#include "gateway/machine/grbl/board_link.hpp"
#include "gateway/machine/grbl/grbl_machine.hpp"
#include "gateway/machine/linuxcnc/helper_link.hpp"
#include "gateway/machine/linuxcnc/linuxcnc_machine.hpp"
#include "gateway/machine/simulated_machine.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::gateway {
namespace {

machine::MachineLimits limits_of(const interpreter::Dialect& control,
                                 const interpreter::MachineData& stated) {
  const bool is_lathe = control.machine == interpreter::MachineKind::Lathe;
  auto limits = is_lathe ? machine::MachineLimits::lathe() : machine::MachineLimits::mill();
  limits.waits_at_tool_change = control.waits_at_tool_change;
  if (control.feed_override_switch.fastest)
    limits.fastest_feed_per_minute = control.feed_override_switch.fastest->mm();
  if (stated.max_rpm) limits.spindle.max_rpm = *stated.max_rpm;
  for (std::size_t i = 0; i < stated.axes.size(); ++i) {
    if (!stated.axes[i]) continue;
    if (!limits.axes[i]) limits.axes[i].emplace();
    machine::AxisLimits& axis = *limits.axes[i];
    axis.min = stated.axes[i]->min.value_or(axis.min);
    axis.max = stated.axes[i]->max.value_or(axis.max);
    axis.acceleration = stated.axes[i]->acceleration.value_or(axis.acceleration);
    if (!stated.axes[i]->max_rate) continue;
    axis.rapid_per_minute = axis.feed_per_minute = *stated.axes[i]->max_rate;
  }
  return limits;
}

/// What `--motion NAME:ADDRESS` consists of.
struct MotionWords {
  std::string_view name, address;
};
MotionWords words_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

struct MotionTask {
  const interpreter::Dialect& control;
  const MotionSetup& setup;
  std::string_view address;
};

Result<machine::MotionFactory> simulated(const MotionTask& task) {
  const auto limits = limits_of(task.control, task.setup.machine);
  return [limits, workpiece = task.setup.workpiece](machine::ExecutionSink& sink) {
    return std::make_unique<machine::SimulatedMachine>(limits, workpiece, sink);
  };
}

/// The connection begins with the machine, and is kept by it.
Result<machine::MotionFactory> grbl(const MotionTask& task) {
  return [address = std::string(task.address),
          stated = task.setup.machine](machine::ExecutionSink& sink) {
    auto machine =
        std::make_unique<machine::grbl::GrblMachine>(machine::grbl::GrblMachine::Settings{
            .sink = sink, .clock = std::make_shared<SystemClock>(), .machine = stated});
    machine->connect(address);
    return machine;
  };
}

/// The helper begins with the machine, and is kept running by it.
Result<machine::MotionFactory> linuxcnc(const MotionTask& task) {
  return
      [ini = std::string(task.address), stated = task.setup.machine](machine::ExecutionSink& sink) {
        auto machine = std::make_unique<machine::linuxcnc::LinuxCncMachine>(
            machine::linuxcnc::LinuxCncMachine::Settings{
                .sink = sink, .clock = std::make_shared<SystemClock>(), .machine = stated});
        machine->connect(ini);
        return machine;
      };
}

Result<machine::MotionFactory> control_on_line(const MotionTask&) {
  return fail(Errc::Unsupported, "motion line: the control at its end moves by itself");
}

Result<void> check_line_address(std::string_view address) {
  const auto parsed = serial::parse_address(std::string(address));
  if (parsed) return {};
  return fail(parsed.error().code, "motion line: {}", parsed.error().what);
}

Result<void> needs_no_address(std::string_view address) {
  if (address.empty()) return {};
  return fail(Errc::Syntax, "motion simulated has no address, '{}' was given", address);
}

Result<void> check_board_address(std::string_view address) {
  const auto parsed = machine::grbl::parse_board_address(address);
  if (parsed) return {};
  return fail(parsed.error().code, "motion grbl: {}", parsed.error().what);
}

Result<void> check_linuxcnc_address(std::string_view address) {
  const auto found = machine::linuxcnc::check_ini_path(std::string(address));
  if (found) return {};
  return fail(found.error().code, "motion linuxcnc: {}", found.error().what);
}

constexpr std::string_view kSimulatedMotion = "simulated", kLineMotion = "line";

struct MotionRow {
  std::string_view name, form;
  Result<void> (*check)(std::string_view address);
  Result<machine::MotionFactory> (*make)(const MotionTask&);
};
constexpr std::array kMotionRows{
    MotionRow{kSimulatedMotion, "simulated", needs_no_address, simulated},
    MotionRow{"linuxcnc", "linuxcnc:INI", check_linuxcnc_address, linuxcnc},
    MotionRow{"grbl", "grbl:ADDRESS", check_board_address, grbl},
    MotionRow{kLineMotion, "line:ADDRESS", check_line_address, control_on_line},
};

Result<const MotionRow*> find_row(std::string_view text) {
  const auto* row = std::ranges::find(kMotionRows, words_of(text).name, &MotionRow::name);
  if (row == kMotionRows.end())
    return fail(Errc::NotFound, "motion '{}' is not known: {}", text, motion_names());
  if (const auto good = row->check(words_of(text).address); !good) return fail(good.error());
  return row;
}

}  // namespace

std::string motion_names() {
  std::string names;
  for (const MotionRow& row : kMotionRows) {
    if (!names.empty()) names += ", ";
    names += row.form;
  }
  return names;
}

bool is_real_motion(std::string_view name) {
  return words_of(name).name != kSimulatedMotion;
}

std::string line_address_of(std::string_view name) {
  const MotionWords words = words_of(name);
  return words.name == kLineMotion ? std::string(words.address) : std::string();
}

Result<void> check_motion(std::string_view name) {
  const auto row = find_row(name);
  if (!row) return fail(row.error());
  return {};
}

Result<machine::MotionFactory> make_motion(std::string_view name,
                                           const interpreter::Dialect& control,
                                           const MotionSetup& setup) {
  const auto row = find_row(name);
  if (!row) return fail(row.error());
  return (*row)->make({control, setup, words_of(name).address});
}

}  // namespace dripline::gateway
