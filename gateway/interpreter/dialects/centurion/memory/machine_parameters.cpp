#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace dripline::interpreter::centurion {
namespace {

constexpr double kFastest = 99999;

constexpr MachineParameter axis_row(std::string_view name, std::string_view title, int number,
                                    double low, double high) {
  return {name, "AXIS", title, number, true, false, true, low, high};
}
/// A length, or a length per minute.
constexpr MachineParameter axis_length(std::string_view name, std::string_view title, int number,
                                       double high) {
  return {name, "AXIS", title, number, true, true, false, 0, high};
}
constexpr MachineParameter power_row(std::string_view name, std::string_view title, int number,
                                     double low, double high) {
  return {name, "POWER", title, number, false, false, true, low, high};
}

constexpr std::array kParameterRows{
    axis_row("address_label", "axis address label (ASCII)", 850, 65, 90),
    axis_row("pulses_per_unit", "feedback pulses per unit", 852, 1, 10'000'000),
    axis_row("encoder_multiplier", "encoder multiplier: 0 x4, 1 x2, 2 x1", 854, 0, 2),
    axis_row("home_direction", "home direction: 0 clockwise, 1 counterclockwise", 856, 0, 1),
    axis_length("velocity_toward_home", "velocity toward home", 858, kFastest),
    axis_length("velocity_away_from_home", "velocity away from home", 860, kFastest),
    axis_length("velocity_toward_marker", "velocity toward marker", 862, kFastest),
    axis_row("home_sequence", "home sequence, 0 never homes", 864, 0, 6),
    axis_length("dry_run_feed", "dry run feed", 866, kFastest),
    axis_length("rapid_velocity", "rapid velocity", 868, kFastest),
    axis_row("rapid_ramp", "rapid acceleration and deceleration", 870, 1, 200),
    axis_length("slow_jog_velocity", "slow jog velocity", 872, kFastest),
    axis_row("slow_jog_ramp", "slow jog acceleration and deceleration", 874, 1, 200),
    axis_length("rapid_jog_velocity", "rapid jog velocity", 876, kFastest),
    axis_row("rapid_jog_ramp", "rapid jog acceleration and deceleration", 878, 1, 200),
    axis_row("jog_key_direction", "jog keys reversed", 880, 0, 1),
    axis_length("in_position", "in position", 882, 100),
    axis_length("backlash", "backlash", 884, 100),
    axis_length("excess_error", "excess error, 0 never", 886, 1000),
    axis_row("is_linear", "rotary 0, linear 1", 888, 0, 1),
    axis_row("home_by_marker", "home switch 0, marker 1", 890, 0, 1),
    axis_length("max_handwheel_error", "max handwheel error", 892, 1000),
    power_row("axes", "number of axes", 900, 1, 6),
    power_row("spindle_axis", "spindle axis", 901, 1, 6),
    power_row("handwheel_encoder_axis", "2nd handwheel encoder axis", 902, 0, 3),
    power_row("full_rapid", "100% rapid in run and dry run", 903, 0, 1),
    power_row("no_canned_cycles", "don't load canned cycles", kNoCannedCycles, 0, 1),
    power_row("atc_pockets", "ATC pockets, 0 no changer", kAtcPockets, 0, kOffsetCount),
    power_row("front_turret", "front turret", 906, 0, 1),
    power_row("parameter_version", "parameter file version", 907, 0, 9999),
    power_row("small_soft_keys", "smaller soft keys", kLastMachineParameter, 0, 1),
};

const MachineParameter* find_row(std::string_view name) {
  const auto* row = std::find_if(kParameterRows.begin(), kParameterRows.end(),
                                 [name](const MachineParameter& r) { return r.name == name; });
  return row == kParameterRows.end() ? nullptr : row;
}

/// true and false are 1 and 0.
std::optional<double> number_of(const OptionValue& option) {
  if (const auto* flag = std::get_if<bool>(&option.value)) return *flag ? 1 : 0;
  if (const auto* whole = std::get_if<std::int64_t>(&option.value)) {
    return static_cast<double>(*whole);
  }
  const auto* number = std::get_if<double>(&option.value);
  return number == nullptr ? std::nullopt : std::optional(*number);
}

Result<void> store(const MachineParameter& row, int axis, const OptionValue& option,
                   Parameters& parameters) {
  const auto value = number_of(option);
  if (!value) {
    return fail(Errc::Syntax, "line {}: [control.machine] {}: expected a number", option.line,
                row.name);
  }
  const bool is_in_range = *value >= row.low && *value <= row.high;
  if (!is_in_range || (row.is_whole && *value != std::trunc(*value))) {
    return fail(Errc::LimitExceeded, "line {}: [control.machine] {}: {} is not {}{} to {}",
                option.line, row.name, *value, row.is_whole ? "a whole number from " : "", row.low,
                row.high);
  }
  parameters[row.number + axis] = *value;
  return {};
}

Result<void> store_axes(const MachineParameter& row, const OptionValue& option,
                        Parameters& parameters) {
  const auto* axes = std::get_if<OptionTable>(&option.value);
  for (std::size_t i = 0; axes != nullptr && i < axes->size(); ++i) {
    const OptionEntry& entry = (*axes)[i];
    if (entry.key != "X" && entry.key != "Z") break;
    if (auto done = store(row, entry.key == "X" ? 1 : 0, entry.value, parameters); !done)
      return done;
    if (i + 1 == axes->size()) return {};
  }
  return fail(Errc::Syntax,
              "line {}: [control.machine] {}: expected both axes or one, as "
              "{{ X = 1.0, Z = 2.0 }}",
              option.line, row.name);
}

std::string known_names() {
  std::string text;
  for (const MachineParameter& row : kParameterRows) {
    if (!text.empty()) text += ", ";
    text += row.name;
  }
  return text;
}

}  // namespace

std::span<const MachineParameter> machine_parameters() {
  return kParameterRows;
}

Result<void> load_machine_parameters(const Options& options, Parameters& parameters) {
  const OptionValue* machine = options.find("machine");
  if (machine == nullptr) return {};
  const auto* table = std::get_if<OptionTable>(&machine->value);
  if (table == nullptr) return fail(Errc::Syntax, "[control] machine: expected a table");
  for (const OptionEntry& entry : *table) {
    const MachineParameter* row = find_row(entry.key);
    if (row == nullptr) {
      return fail(Errc::Unsupported,
                  "line {}: [control.machine] {}: this control has no such parameter; it has {}",
                  entry.value.line, entry.key, known_names());
    }
    auto done = row->is_per_axis ? store_axes(*row, entry.value, parameters)
                                 : store(*row, 0, entry.value, parameters);
    if (!done) return done;
  }
  return {};
}

Result<Pockets> read_pockets(const Setup& setup, int pocket_count) {
  Pockets pockets{};
  if (pocket_count == 0) return pockets;
  for (int tool = 1; tool <= pocket_count; ++tool) pockets[static_cast<std::size_t>(tool)] = tool;
  for (const ToolRecord& tool : setup.tools) {
    if (!tool.pocket || tool.number < 1 || tool.number > kOffsetCount) continue;
    if (*tool.pocket < 0 || *tool.pocket > pocket_count) {
      return fail(Errc::LimitExceeded, "tool {}: pocket {} is not 0 to {}", tool.number,
                  *tool.pocket, pocket_count);
    }
    pockets[static_cast<std::size_t>(tool.number)] = *tool.pocket;
  }
  for (std::size_t one = 1; one < pockets.size(); ++one) {
    for (std::size_t other = one + 1; other < pockets.size(); ++other) {
      if (pockets[one] == 0 || pockets[one] != pockets[other]) continue;
      return fail(Errc::Syntax, "tools {} and {}: both in pocket {}", one, other, pockets[one]);
    }
  }
  return pockets;
}

}  // namespace dripline::interpreter::centurion
