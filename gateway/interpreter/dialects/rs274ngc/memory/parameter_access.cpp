#include "gateway/interpreter/dialects/rs274ngc/memory/parameter_access.hpp"

#include <fmt/core.h>
#include <array>
#include <utility>

#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/tool_table.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

int highest(const Run& run) {
  return (run.is_linuxcnc() ? kAllParameters : kNistParameters) - 1;
}

/// A coordinate of the machine's memory in the units in force.
double shown(const Run& run, Axis axis, double value) {
  return is_rotary(axis) ? value : value / run.state.mm_per_unit();
}

/// 5401 to 5413: the row of the tool in the spindle as the table has it, in machine units, whatever
/// length is in force.
double parameter_of_tool(const Run& run, int index) {
  const Tool* tool = find_tool(run, run.state.tool.loaded);
  if (tool == nullptr) return 0;
  switch (index) {
    case 5410:
      return to_memory(run, Axis::X, tool->diameter);
    case 5411:
      return tool->front_angle;
    case 5412:
      return tool->back_angle;
    case 5413:
      return tool->orientation;
    default:
      break;
  }
  const Axis axis = kAllAxes[static_cast<std::size_t>(index - 5401)];
  return to_memory(run, axis, tool->length[index_of(axis)]);
}

/// Parameters from 5400 on show the state.
double live_parameter(const Run& run, int index) {
  const State& state = run.state;
  if (index >= kCurrentPosition && index < kCurrentPosition + static_cast<int>(kAxisCount)) {
    const Axis axis = kAllAxes[static_cast<std::size_t>(index - kCurrentPosition)];
    return shown(run, axis, state[axis]);
  }
  if (index == 5400) return state.tool.loaded;
  if (index > 5400 && index <= 5413) return parameter_of_tool(run, index);
  return run.parameters[static_cast<std::size_t>(index)];
}

struct SystemName {
  std::string_view name;
  double (*value)(const Run& run);
};

double flag(bool holds) {
  return holds ? 1 : 0;
}
template <Axis kAxis>
double relative(const Run& run) {
  return shown(run, kAxis, run.state[kAxis]);
}
/// Machine coordinates of the spindle: those of the tool's tip with its length on top.
template <Axis kAxis>
double absolute(const Run& run) {
  const double length = run.state.tool_length[index_of(kAxis)];
  return shown(run, kAxis, run.state.machine.raw(kAxis) + length);
}
using R = const Run&;
double radius_mode(R run) {
  return 400 + 10 * static_cast<int>(run.state.compensation.side);  // off, left, right
}
double system_code(R run) {
  const int system = run.state.system;
  return system <= 6 ? 530 + 10 * system : 584 + system;
}
double plane_code(R run) {
  return 170 + 10 * static_cast<int>(run.state.modes.plane);  // XY, ZX, YZ
}

constexpr std::array kSystemNames{
    SystemName{"_vmajor", [](R) { return 2.9; }},
    SystemName{"_vminor", [](R) { return 0.0; }},
    SystemName{"_line", [](R run) { return static_cast<double>(run.origin.line); }},
    SystemName{"_motion_mode", [](R run) { return static_cast<double>(run.state.modes.motion); }},
    SystemName{"_plane", plane_code},
    SystemName{"_ccomp", radius_mode},
    SystemName{"_metric", [](R run) { return flag(run.state.units == Units::Millimeter); }},
    SystemName{"_imperial", [](R run) { return flag(run.state.units == Units::Inch); }},
    SystemName{"_absolute", [](R run) { return flag(!run.state.modes.is_incremental); }},
    SystemName{"_incremental", [](R run) { return flag(run.state.modes.is_incremental); }},
    SystemName{"_inverse_time",
               [](R run) { return flag(run.state.modes.feed == FeedMode::InverseTime); }},
    SystemName{"_units_per_minute",
               [](R run) { return flag(run.state.modes.feed == FeedMode::PerMinute); }},
    SystemName{"_units_per_rev",
               [](R run) { return flag(run.state.modes.feed == FeedMode::PerRevolution); }},
    SystemName{"_coord_system", system_code},
    SystemName{"_tool_offset", [](R run) { return flag(run.state.tool_length != Axes{}); }},
    SystemName{"_retract_r_plane", [](R run) { return flag(!run.state.modes.retracts_to_start); }},
    SystemName{"_retract_old_z", [](R run) { return flag(run.state.modes.retracts_to_start); }},
    SystemName{"_spindle_rpm_mode", [](R run) { return flag(!run.state.spindle.is_surface); }},
    SystemName{"_spindle_css_mode", [](R run) { return flag(run.state.spindle.is_surface); }},
    SystemName{"_ijk_absolute_mode", [](R run) { return flag(run.state.modes.is_arc_absolute); }},
    SystemName{"_lathe_diameter_mode", [](R run) { return flag(run.state.modes.is_diameter); }},
    SystemName{"_lathe_radius_mode", [](R run) { return flag(!run.state.modes.is_diameter); }},
    SystemName{"_spindle_on", [](R run) { return flag(run.state.spindle.is_turning()); }},
    SystemName{"_spindle_cw",
               [](R run) { return flag(run.state.spindle.state == SpindleState::Clockwise); }},
    SystemName{"_mist", [](R run) { return flag(run.state.mist); }},
    SystemName{"_flood", [](R run) { return flag(run.state.flood); }},
    SystemName{"_speed_override", [](R run) { return flag(run.state.overrides.speed); }},
    SystemName{"_feed_override", [](R run) { return flag(run.state.overrides.feed); }},
    SystemName{"_adaptive_feed", [](R run) { return flag(run.state.overrides.adaptive); }},
    SystemName{"_feed_hold", [](R run) { return flag(run.state.overrides.hold); }},
    SystemName{"_feed", [](R run) { return run.state.shown_feed(); }},
    SystemName{"_rpm", [](R run) { return run.state.spindle.speed; }},
    SystemName{"_x", relative<Axis::X>},
    SystemName{"_y", relative<Axis::Y>},
    SystemName{"_z", relative<Axis::Z>},
    SystemName{"_a", relative<Axis::A>},
    SystemName{"_b", relative<Axis::B>},
    SystemName{"_c", relative<Axis::C>},
    SystemName{"_u", relative<Axis::U>},
    SystemName{"_v", relative<Axis::V>},
    SystemName{"_w", relative<Axis::W>},
    SystemName{"_abs_x", absolute<Axis::X>},
    SystemName{"_abs_y", absolute<Axis::Y>},
    SystemName{"_abs_z", absolute<Axis::Z>},
    SystemName{"_abs_a", absolute<Axis::A>},
    SystemName{"_abs_b", absolute<Axis::B>},
    SystemName{"_abs_c", absolute<Axis::C>},
    SystemName{"_abs_u", absolute<Axis::U>},
    SystemName{"_abs_v", absolute<Axis::V>},
    SystemName{"_abs_w", absolute<Axis::W>},
    SystemName{"_current_tool", [](R run) { return static_cast<double>(run.state.tool.loaded); }},
    SystemName{"_current_pocket", [](R run) { return static_cast<double>(run.state.tool.loaded); }},
    SystemName{"_selected_tool",
               [](R run) { return static_cast<double>(run.state.tool.selected); }},
    SystemName{"_selected_pocket",
               [](R run) { return static_cast<double>(run.state.tool.selected); }},
    SystemName{"_task", [](R) { return 0.0; }},
    SystemName{"_call_level", [](R run) { return static_cast<double>(run.state.calls.size()); }},
    SystemName{"_remap_level", [](R) { return 0.0; }},
    // Of the last return; before any there is nothing to show.
    SystemName{"_value", [](R) { return 0.0; }},
    SystemName{"_value_returned", [](R) { return 0.0; }},
};

const SystemName* find_system(std::string_view name) {
  if (name.front() != '_') return nullptr;
  for (const SystemName& each : kSystemNames) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

const double* find_user(Run& run, std::string_view name) {
  const NameId id = run.names.find(name);
  return id == kNoName ? nullptr : run.names.value(id, run.state.calls.size());
}

/// #<_hal[NAME]> of LinuxCNC; empty: another name.
std::string_view hal_name(std::string_view name) {
  constexpr std::string_view kBegin = "_hal[";
  if (!name.starts_with(kBegin) || !name.ends_with(']')) return {};
  return name.substr(kBegin.size(), name.size() - kBegin.size() - 1);
}

SignalValue listed_value(const Run& run, std::string_view hal) {
  const auto found = run.options.hal->find(hal);
  if (found != run.options.hal->end()) return {found->second, ""};
  return {std::nullopt, "the setup's `hal` does not have it"};
}

/// Of this reading of the line. nullptr: the machine has been asked, or has answered with too much.
const SignalValue* find_signal(Run& run, std::string_view hal) {
  for (const Run::Signal& known : run.signals)
    if (known.name == hal) return &known.value;
  auto value = ask_signal(run, hal);
  if (!value) return nullptr;
  return &run.signals.emplace_back(Run::Signal{std::string(hal), *std::move(value)}).value;
}

bool read_signal(Run& run, std::string_view hal, std::uint32_t column, double& value) {
  const SignalValue* signal = find_signal(run, hal);
  if (signal == nullptr) return false;
  if (signal->value) {
    value = *signal->value;
    return true;
  }
  return run.fail(ErrorCode::NoSignal, column, fmt::format("{}: {}", hal, signal->reason));
}

}  // namespace

bool read_parameter(Run& run, double index, std::uint32_t column, double& value) {
  if (!(index >= 1 && index <= highest(run))) [[unlikely]] {
    return run.fail(ErrorCode::ParameterRange, column,
                    fmt::format("#{} is not in 1 to {}", index, highest(run)));
  }
  const auto at = static_cast<std::size_t>(index);
  // The position is that of the shifted path, and not even its end.
  if (at >= kCurrentPosition && at < kCurrentPosition + kAxisCount && run.is_linuxcnc() &&
      run.state.compensation.side != Side::Off) [[unlikely]]
    return run.fail(ErrorCode::CompNotAllowed, column, fmt::format("reading #{}", index));
  value = at < kFirstReadOnly ? run.parameters[at] : live_parameter(run, static_cast<int>(at));
  return true;
}

bool check_settable(Run& run, double index, std::uint32_t column) {
  double ignored = 0;
  if (!read_parameter(run, index, column, ignored)) return false;
  if (index < kFirstReadOnly || index == kDebugSwitch) return true;
  return run.fail(ErrorCode::ParameterReadonly, column, fmt::format("#{}", index));
}

bool read_named(Run& run, std::string_view name, std::uint32_t column, double& value) {
  if (const double* user = find_user(run, name)) [[likely]] {
    value = *user;
    return true;
  }
  if (const SystemName* system = find_system(name)) {
    value = system->value(run);
    return true;
  }
  if (const auto hal = hal_name(name); !hal.empty()) return read_signal(run, hal, column, value);
  return run.fail(ErrorCode::NotDefined, column, fmt::format("#<{}>", name));
}

bool is_defined(Run& run, std::string_view name, bool& is_there) {
  is_there = find_user(run, name) != nullptr || find_system(name) != nullptr;
  const auto hal = hal_name(name);
  if (is_there || hal.empty()) return true;
  const SignalValue* signal = find_signal(run, hal);
  is_there = signal != nullptr && signal->value;
  return signal != nullptr;
}

bool name_to_set(Run& run, std::string_view name, std::uint32_t column, NameId& id) {
  id = run.names.find(name);
  if (id != kNoName) [[likely]]
    return true;
  if (find_system(name) != nullptr || !hal_name(name).empty()) {
    return run.fail(ErrorCode::ParameterReadonly, column, fmt::format("#<{}>", name));
  }
  id = run.names.id_of(name);
  if (id != kNoName) return true;
  return run.fail(ErrorCode::TooManyNames, column, fmt::format("more than {}", kMaxNames));
}

std::optional<double> parameter_for_text(Run& run, int index) {
  if (index < 1 || index > highest(run)) return std::nullopt;
  return index < kFirstReadOnly ? run.parameters[static_cast<std::size_t>(index)]
                                : live_parameter(run, index);
}

std::optional<double> named_for_text(Run& run, std::string_view name) {
  if (name.empty()) return std::nullopt;
  if (const double* user = find_user(run, name)) return *user;
  if (const SystemName* system = find_system(name)) return system->value(run);
  const auto hal = hal_name(name);  // a comment asks nothing: what its line has read
  for (const Run::Signal& known : run.signals)
    if (!hal.empty() && known.name == hal) return known.value.value;
  return std::nullopt;
}

std::optional<SignalValue> ask_signal(Run& run, std::string_view hal) {
  if (run.options.hal) return listed_value(run, hal);
  if (run.answer) return std::get<SignalValue>(*std::exchange(run.answer, std::nullopt));
  run.ask(SignalQuestion{std::string(hal)});
  return std::nullopt;
}

}  // namespace dripline::interpreter::rs274ngc
