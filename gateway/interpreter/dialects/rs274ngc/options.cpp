#include "gateway/interpreter/dialects/rs274ngc/options.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "gateway/interpreter/core/option.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/retained_memory.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

Result<AddressSet> read_axes(const Options& options) {
  const auto letters = options.text("axes", "XYZABC");
  if (!letters) return fail(letters.error());
  AddressSet axes = 0;
  for (const char c : *letters) {
    if (!axis_of(c)) return fail(Errc::Syntax, "[control] axes: \"{}\" is not an axis", c);
    axes |= set_of(c);
  }
  return axes;
}

Result<std::uint64_t> read_limit(const Options& options, std::string_view name,
                                 std::uint64_t fallback) {
  const auto value = options.integer(name, static_cast<std::int64_t>(fallback));
  if (!value) return fail(value.error());
  if (*value < 1) return fail(Errc::Syntax, "[control] {}: expected a number from 1", name);
  return static_cast<std::uint64_t>(*value);
}

Result<void> read_limits(const Options& options, ControlOptions& control) {
  const auto passes = read_limit(options, "max_passes", control.max_passes);
  const auto restarts = read_limit(options, "max_loops", control.max_restarts);
  const auto slots = read_limit(options, "slots", static_cast<std::uint64_t>(control.slots));
  if (!passes) return fail(passes.error());
  if (!restarts) return fail(restarts.error());
  if (!slots) return fail(slots.error());
  if (*slots > 99'999) return fail(Errc::Syntax, "[control] slots: at most 99999");
  control.max_passes = *passes;
  control.max_restarts = *restarts;
  control.slots = static_cast<int>(*slots);
  return {};
}

Result<void> read_tolerance(const Options& options, ControlOptions& control) {
  constexpr double kLeast = 1e-6;
  const auto tolerance = options.length("spline_tolerance", Length::mm(control.spline_tolerance));
  if (!tolerance) return fail(tolerance.error());
  if (!(tolerance->mm() >= kLeast)) {
    return fail(Errc::Syntax, "[control] spline_tolerance: {} mm is below {} mm", tolerance->mm(),
                kLeast);
  }
  control.spline_tolerance = tolerance->mm();
  return {};
}

Result<void> read_pins(const Options& options, ControlOptions& control) {
  const auto pins = options.integers("pins");
  if (!pins) return fail(pins.error());
  control.pins = *pins;
  control.answers_pins = options.find("pins") != nullptr;
  return {};
}

}  // namespace

Result<ControlOptions> read_options(const Setup& setup) {
  const Options& options = setup.control;
  if (auto known = options.check_known({"profile", "axes", "ignore_missing_axis_words", "slots",
                                        "max_passes", "max_loops", "pins", "spline_tolerance",
                                        "tool_changer"});
      !known) {
    return fail(known.error());
  }
  if (!setup.switches.mirror.empty()) {
    return fail(Errc::Unsupported, "switches.mirror: this control has no mirror switch");
  }
  ControlOptions control;
  const auto profile = options.choice("profile", {"nist", "linuxcnc"}, 0);
  const auto axes = read_axes(options);
  const auto ignores = options.flag("ignore_missing_axis_words", false);
  if (!profile) return fail(profile.error());
  if (!axes) return fail(axes.error());
  if (!ignores) return fail(ignores.error());
  const auto has_changer = options.flag("tool_changer", true);
  if (!has_changer) return fail(has_changer.error());
  control.has_tool_changer = *has_changer;
  control.profile = *profile == 0 ? Profile::Nist : Profile::LinuxCnc;
  control.axes = *axes;
  control.ignores_missing_axes = *ignores;
  if (auto read = read_limits(options, control); !read) return fail(read.error());
  if (auto read = read_tolerance(options, control); !read) return fail(read.error());
  if (auto read = read_pins(options, control); !read) return fail(read.error());
  control.block_skip = setup.switches.block_skip;
  control.optional_stop = setup.switches.optional_stop;
  if (setup.units.value_or(Units::Millimetre) == Units::Inch) {
    control.mm_per_machine_unit = Length::kMillimetresPerInch;
  }
  return control;
}

namespace {

double in_memory(const ControlOptions& options, Axis axis, double mm) {
  return is_rotary(axis) ? mm : mm / options.mm_per_machine_unit;
}

/// G54 to G59.3, G92, G28, G30 as names of records.
std::optional<int> first_parameter(std::string_view name) {
  constexpr std::array<std::string_view, kSystems> kNames{"G54", "G55",   "G56",   "G57",  "G58",
                                                          "G59", "G59.1", "G59.2", "G59.3"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return first_of_system(static_cast<int>(i) + 1);
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

Tool tool_of(const ToolRecord& record) {
  Tool tool;
  tool.number = record.number;
  for (const Axis axis : kAllAxes) {
    tool.length[index_of(axis)] = record.length.raw(axis) + record.wear.raw(axis);
  }
  tool.diameter = 2 * (record.radius.mm() + record.radius_wear.mm());
  return tool;
}

void load_active_offsets(const ControlOptions& options, const Parameters& parameters,
                         State& state) {
  const int first = first_of_system(state.system);
  for (const Axis axis : kAllAxes) {
    const std::size_t i = index_of(axis);
    const double scale = is_rotary(axis) ? 1 : options.mm_per_machine_unit;
    state.system_offset[i] = parameters[static_cast<std::size_t>(first) + i] * scale;
    state.g92[i] = parameters[kG92Offsets + i] * scale;
  }
  if (options.is_linuxcnc()) {
    state.rotation = parameters[static_cast<std::size_t>(first + kSystemRotation)];
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
  for (const ToolRecord& record : setup.tools) {
    if (!options.is_linuxcnc() && record.number > options.slots) {
      return fail(Errc::Unsupported, "tool {}: this changer has {} slots", record.number,
                  options.slots);
    }
    tools.push_back(tool_of(record));
  }
  if (auto loaded = load_tool_cells(setup, tools); !loaded) return loaded;
  const double system = parameters[kSystemNumber];
  if (!(system >= 1 && system <= kSystems) || system != std::round(system)) {
    return fail(Errc::Unsupported, "variable #5220: {} is not a coordinate system, 1 to 9", system);
  }
  state.system = static_cast<std::uint8_t>(system);
  state.units = setup.units.value_or(Units::Millimetre);
  load_active_offsets(options, parameters, state);
  for (const Axis axis : kAllAxes) state.machine.set_raw(axis, setup.start.raw(axis));
  state.machine.unmark_all();
  return {};
}

}  // namespace dripline::interpreter::rs274ngc
