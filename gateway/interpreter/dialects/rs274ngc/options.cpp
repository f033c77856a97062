#include "gateway/interpreter/dialects/rs274ngc/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/retained_memory.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

using C = ControlOptions;
using Row = OptionRow<C>;

Result<void> read_axes(const Options& options, const OptionKey& key, C& control) {
  const auto letters = options.text(key.key, key.fallback);
  if (!letters) return fail(letters.error());
  for (const char c : *letters) {
    if (!axis_of(c)) return fail(Errc::Syntax, "[control] axes: \"{}\" is not an axis", c);
    control.axes |= set_of(c);
  }
  return {};
}

Result<void> read_startup_code(const Options& options, const OptionKey& key, C& control) {
  return assign(options.text(key.key, ""), control.startup_code);
}

/// A table of names and numbers, as the machine's HAL has them.
Result<void> read_hal(const Options& options, const OptionKey& key, C& control) {
  const OptionValue* given = options.find(key.key);
  if (given == nullptr) return {};
  const auto* table = std::get_if<OptionTable>(&given->value);
  if (table == nullptr) return fail(Errc::Syntax, "[control] hal: expected a table");
  auto& values = control.hal.emplace();
  for (const OptionEntry& entry : *table) {
    const auto* whole = std::get_if<std::int64_t>(&entry.value.value);
    const auto* real = std::get_if<double>(&entry.value.value);
    const auto* flag = std::get_if<bool>(&entry.value.value);
    if (whole == nullptr && real == nullptr && flag == nullptr)
      return fail(Errc::Syntax, "[control] hal: {} needs a number, true or false", entry.key);
    values[entry.key] = whole != nullptr  ? static_cast<double>(*whole)
                        : real != nullptr ? *real
                                          : static_cast<double>(*flag);
  }
  return {};
}

constexpr std::array kRows{
    row<&C::profile>("profile", "nist|linuxcnc", "which language programs are in"),
    Row{{"axes", kText, "letters of the axes that the machine has", "XYZABC"}, read_axes},
    row<&C::ignores_missing_axes>("ignore_missing_axis_words", kFlag,
                                  "true: words of other axes have no effect; else an alarm"),
    row<&C::has_tool_changer>("tool_changer", kFlag,
                              "false: M6 stops and waits until the operator has changed the tool"),
    row<&C::slots>("slots", kWhole,
                   "slots of the tool changer: highest T, H and D of the profile nist",
                   {1, 99'999}),
    row<&C::max_passes>("max_passes", kWhole,
                        "passes of loops and calls without a move before an alarm", {.low = 1}),
    row<&C::max_restarts>("max_loops", kWhole,
                          "restarts of the main program by M99 without a move before an alarm",
                          {.low = 1}),
    row<&C::spline_tolerance>("spline_tolerance", kLength,
                              "distance of a spline's straight pieces from the curve",
                              {.low = 1e-6}),
    Row{{"startup_code", kText,
         "RS274NGC_STARTUP_CODE of LinuxCNC's INI file: modes that programs begin with", "none"},
        read_startup_code},
    pins_row<&C::pins, &C::answers_pins>(),
    Row{{"hal", "table", "HAL pins that programs read: { \"motion.in-position\" = 1 }",
         "the machine is asked"},
        read_hal},
};

}  // namespace

std::vector<ListedOption> list_options() {
  return list_rows(kRows);
}

Result<ControlOptions> read_options(const Setup& setup) {
  ControlOptions control;
  if (auto done = read_rows(kRows, setup.control, control); !done) return fail(done.error());
  if (!setup.switches.mirror.empty()) {
    return fail(Errc::Unsupported, "switches.mirror: this control has no mirror switch");
  }
  control.block_skip = setup.switches.block_skip;
  control.optional_stop = setup.switches.optional_stop;
  control.is_mdi = setup.is_mdi;
  if (setup.units.value_or(Units::Millimeter) == Units::Inch) {
    control.mm_per_machine_unit = Length::kMillimetersPerInch;
  }
  return control;
}

namespace {

double in_memory(const ControlOptions& options, Axis axis, double mm) {
  return is_rotary(axis) ? mm : mm / options.mm_per_machine_unit;
}

/// G54 to G59.3, G92, G28, G30 as names of records.
std::optional<int> first_parameter(std::string_view name) {
  for (std::size_t i = 0; i < kWorkSystems.size(); ++i) {
    if (name == kWorkSystems[i]) return first_of_system(static_cast<int>(i) + 1);
  }
  if (name == "G92") return kG92Offsets;
  if (name == "G28") return kHome;
  if (name == "G30") return kSecondHome;
  return std::nullopt;
}

Result<void> load_offset(const OffsetRecord& offset, const ControlOptions& options,
                         Parameters& parameters) {
  const auto first = first_parameter(offset.name);
  if (!first) {
    return fail(Errc::Unsupported, "offset {}: this control has G54 to G59.3, G92, G28 and G30",
                offset.name);
  }
  for (const Axis axis : kAllAxes) {
    if (!offset.value.has(axis)) continue;
    parameters[static_cast<std::size_t>(*first) + index_of(axis)] =
        in_memory(options, axis, offset.value.raw(axis));
  }
  return {};
}

/// tool.3.Z: what the tool table kept (retained_memory.hpp).
bool is_of_tool(std::string_view name) {
  return name.starts_with("tool.");
}
Result<void> load_tool_cells(const Setup& setup, std::vector<Tool>& tools) {
  std::map<std::string, double> cells;
  for (const VariableRecord& variable : setup.variables) {
    if (is_of_tool(variable.name)) cells[variable.name] = variable.value;
  }
  const auto unknown =
      write_cells(std::move(cells), [&](auto visit) { for_each_tool_cell(tools, visit); });
  if (unknown.empty()) return {};
  return fail(Errc::Unsupported, "variable {}: the tool table has none", unknown.begin()->first);
}

/// `#100` or `100`.
Result<void> load_variable(const VariableRecord& variable, const ControlOptions& options,
                           Parameters& parameters) {
  if (is_of_tool(variable.name)) return {};
  std::string_view digits = variable.name;
  if (digits.starts_with('#')) digits.remove_prefix(1);
  int number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const int most = (options.is_linuxcnc() ? kFirstReadOnly : kNistParameters) - 1;
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() || number < 1 ||
      number > most) {
    return fail(Errc::Unsupported, "variable {}: this control has #1 to #{}", variable.name, most);
  }
  parameters[static_cast<std::size_t>(number)] = variable.value;
  return {};
}

/// An offset that the setup states is in force. That of the memory may be one that G92.2, or M2 of
/// the profile nist, has taken out of force.
void mark_g92(const Setup& setup, Parameters& parameters) {
  const auto is_mark = [](const VariableRecord& variable) {
    return variable.name == "#5210" || variable.name == "5210";
  };
  if (std::ranges::any_of(setup.variables, is_mark)) return;
  const auto values = std::span(parameters).subspan(kG92Offsets, kAxisCount);
  if (std::ranges::any_of(values, [](double value) { return value != 0; }))
    parameters[kG92Active] = 1;
}

Tool tool_of(const ToolRecord& record, const ControlOptions& options) {
  Tool tool;
  tool.number = record.number;
  for (const Axis axis : kAllAxes) {
    tool.length[index_of(axis)] = record.length.raw(axis) + record.wear.raw(axis);
  }
  tool.diameter = 2 * (record.radius.mm() + record.radius_wear.mm());
  if (options.is_linuxcnc()) tool.orientation = record.tip;
  return tool;
}

void load_active_offsets(const ControlOptions& options, const Parameters& parameters,
                         State& state) {
  const auto first = static_cast<std::size_t>(first_of_system(state.system));
  const bool has_g92 = parameters[kG92Active] != 0;
  for (const Axis axis : kAllAxes) {
    const std::size_t i = index_of(axis);
    const double scale = is_rotary(axis) ? 1 : options.mm_per_machine_unit;
    state.system_offset[i] = parameters[first + i] * scale;
    state.g92[i] = has_g92 ? parameters[kG92Offsets + i] * scale : 0;
  }
  if (options.is_linuxcnc()) {
    state.rotation = parameters[first + kSystemRotation];
  }
}

}  // namespace

Result<void> load_memory(const Setup& setup, const ControlOptions& options, State& state,
                         Parameters& parameters, std::vector<Tool>& tools) {
  parameters.fill(0);
  parameters[kSystemNumber] = 1;
  for (const OffsetRecord& offset : setup.offsets) {
    if (auto loaded = load_offset(offset, options, parameters); !loaded) return loaded;
  }
  for (const VariableRecord& variable : setup.variables) {
    if (auto loaded = load_variable(variable, options, parameters); !loaded) return loaded;
  }
  mark_g92(setup, parameters);
  for (const ToolRecord& record : setup.tools) {
    if (!options.is_linuxcnc() && record.number > options.slots) {
      return fail(Errc::Unsupported, "tool {}: this changer has {} slots", record.number,
                  options.slots);
    }
    tools.push_back(tool_of(record, options));
  }
  if (auto loaded = load_tool_cells(setup, tools); !loaded) return loaded;
  const double system = parameters[kSystemNumber];
  if (!(system >= 1 && system <= kSystems) || system != std::round(system)) {
    return fail(Errc::Unsupported, "variable #5220: {} is not a coordinate system, 1 to 9", system);
  }
  state.system = static_cast<std::uint8_t>(system);
  state.units = setup.units.value_or(Units::Millimeter);
  load_active_offsets(options, parameters, state);
  for (const Axis axis : kAllAxes) state.machine.set_raw(axis, setup.start.raw(axis));
  state.machine.unmark_all();
  return {};
}

}  // namespace dripline::interpreter::rs274ngc
