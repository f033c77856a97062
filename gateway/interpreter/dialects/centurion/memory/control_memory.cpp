#include "gateway/interpreter/dialects/centurion/memory/control_memory.hpp"

#include "gateway/interpreter/core/option.hpp"
#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::interpreter::centurion {
namespace {

Units units_of(const Setup& setup) {
  return setup.units.value_or(Units::Inch);
}

double in_units(Length length, Units units) {
  return units == Units::Inch ? length.inch() : length.mm();
}

Result<bool> stored_x_is_diameter(const Options& options) {
  const auto choice = options.choice("stored_x", {"radius", "diameter"}, 0);
  if (!choice) return fail(choice.error());
  return *choice == 1;
}

Result<void> load_axes(const Position& position, std::string_view what) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (!position.has(axis) || axis == Axis::X || axis == Axis::Z) continue;
    return fail(Errc::Unsupported, "{}: this lathe has no axis {}", what, letter(axis));
  }
  return {};
}

/// Stores a place of the machine in P`first` (Z) and the next one (X).
Result<void> load_place(const Position& place, std::string_view what, int first, const Setup& setup,
                        Parameters& parameters) {
  if (auto checked = load_axes(place, what); !checked) return checked;
  const auto is_diameter = stored_x_is_diameter(setup.control);
  if (!is_diameter) return fail(is_diameter.error());
  const Units units = units_of(setup);
  parameters[first] = in_units(place.linear(Axis::Z), units);
  parameters[first + 1] = in_units(place.linear(Axis::X), units) / (*is_diameter ? 2 : 1);
  return {};
}

bool is_zero(const OptionValue& option) {
  const auto* number = std::get_if<std::int64_t>(&option.value);
  return number != nullptr && *number == 0;
}

/// The axis parameters and reference points (manual: set-up pages COORD and AXIS). A plain 0 leaves
/// all axes at 0.
Result<void> load_places(const Setup& setup, Parameters& parameters) {
  constexpr std::size_t kMaxReferences = 4;
  const Options& options = setup.control;
  for (const PlaceOption& option : kPlaceOptions) {
    const OptionValue* value = options.find(option.name);
    if (value == nullptr || is_zero(*value)) continue;
    const auto place = options.position(option.name);
    if (!place) return fail(place.error());
    auto loaded = load_place(*place, option.name, option.parameter, setup, parameters);
    if (!loaded) return loaded;
    // a feed is not a position: it is always that of the radius
    if (option.parameter == kMaximumFeed) {
      parameters[kMaximumFeed + 1] = in_units(place->linear(Axis::X), units_of(setup));
    }
  }
  const OptionValue* value = options.find("reference");
  if (value == nullptr || is_zero(*value)) return {};
  const auto points = options.positions("reference");
  if (!points) return fail(points.error());
  if (points->size() > kMaxReferences) {
    return fail(Errc::LimitExceeded, "[control] reference: {} points, this control has {}",
                points->size(), kMaxReferences);
  }
  for (std::size_t i = 0; i < points->size(); ++i) {
    const int first = kReferencePoints + 2 * static_cast<int>(i);
    auto loaded = load_place((*points)[i], "reference", first, setup, parameters);
    if (!loaded) return loaded;
  }
  return {};
}

/// G54 to G59, G50 and G52.
Result<void> load_offset(const OffsetRecord& offset, bool is_diameter, ModalState& state,
                         Parameters& parameters) {
  if (auto checked = load_axes(offset.value, offset.name); !checked) return checked;
  const Point value{in_units(offset.value.linear(Axis::X), state.units) / (is_diameter ? 2 : 1),
                    in_units(offset.value.linear(Axis::Z), state.units)};
  if (offset.name == "G50") {
    state.floating_zero = value;
  } else if (offset.name == "G52") {
    state.local_zero = value;
  } else if (offset.name.size() == 3 && offset.name.starts_with("G5") && offset.name[2] >= '4' &&
             offset.name[2] <= '9') {
    const int first = kWorkOffsets + 2 * (offset.name[2] - '4');
    parameters[first] = value.z;
    parameters[first + 1] = value.x;
  } else {
    return fail(Errc::Unsupported, "offset {}: this control has G54 to G59, G50 and G52",
                offset.name);
  }
  return {};
}

Result<void> load_tool(const ToolRecord& tool, Units units, Parameters& parameters) {
  if (tool.number < 1 || tool.number > kOffsetCount) {
    return fail(Errc::Unsupported, "tool {}: this control has 1 to {}", tool.number, kOffsetCount);
  }
  if (tool.tip < 0 || tool.tip > 9) {
    return fail(Errc::Unsupported, "tool {}: type {} is not 0 to 9", tool.number, tool.tip);
  }
  if (auto checked = load_axes(tool.length, "tool length"); !checked) return checked;
  const auto set = [&](ToolField field, double value) {
    parameters[Parameters::tool_parameter(tool.number, field)] = value;
  };
  set(ToolField::LengthZ, in_units(tool.length.linear(Axis::Z), units));
  set(ToolField::LengthX, in_units(tool.length.linear(Axis::X), units));
  set(ToolField::WearZ, in_units(tool.wear.linear(Axis::Z), units));
  set(ToolField::WearX, in_units(tool.wear.linear(Axis::X), units));
  set(ToolField::Radius, in_units(tool.radius, units));
  set(ToolField::WearRadius, in_units(tool.radius_wear, units));
  set(ToolField::Type, tool.tip);
  return {};
}

/// P10 or PB81.
Result<void> load_variable(const VariableRecord& variable, Parameters& parameters) {
  const std::string_view name = variable.name;
  const bool is_byte = name.starts_with("PB");
  const auto number = parse_decimal(name.substr(is_byte ? 2 : name.starts_with("P") ? 1 : 0));
  const int count = is_byte ? kByteCount : kParameterCount;
  const bool is_status = number && number->digits >= kFirstStatus && number->digits <= kLastStatus;
  if (!name.starts_with("P") || !number || number->scale != 0 || number->digits < 0 ||
      number->digits >= count || (!is_byte && is_status)) {
    return fail(Errc::Unsupported,
                "variable {}: this control has P0 to P199, P371 to P{} and PB0 "
                "to PB{}",
                name, kParameterCount - 1, kByteCount - 1);
  }
  const int index = static_cast<int>(number->digits);
  if (!is_byte) {
    parameters[index] = variable.value;
    return {};
  }
  if (!(variable.value >= 0 && variable.value <= 255)) {
    return fail(Errc::LimitExceeded, "variable {}: {} is not 0 to 255", name, variable.value);
  }
  parameters.byte(index) = static_cast<std::uint8_t>(variable.value);
  return {};
}

/// The feed, the special flags and the rest of the state at power-on.
Result<void> load_power_on(const Options& options, ModalState& state, Parameters& parameters) {
  const auto feed = options.number("power_on_feed", 10);
  if (!feed) return fail(feed.error());
  const auto mode = options.choice("power_on_feed_mode", {"per_min", "per_rev"}, 1);
  if (!mode) return fail(mode.error());
  state.modes.is_feed_per_revolution = *mode == 1;
  state.feed[*mode] = *feed;
  const auto flags = options.integer("special_flags", 0);
  if (!flags) return fail(flags.error());
  if (*flags < 0 || *flags > 255) {
    return fail(Errc::LimitExceeded, "[control] special_flags: {} is not 0 to 255", *flags);
  }
  parameters.byte(kSpecialFlags) = static_cast<std::uint8_t>(*flags);
  const auto range = options.choice("spindle_range", {"low", "medium", "high"}, 0);
  if (!range) return fail(range.error());
  parameters.byte(kSpindleRange) = static_cast<std::uint8_t>(*range + 1);
  parameters[188] = parameters[189] = 1;  // scale factors
  return {};
}

}  // namespace

Result<void> load_memory(const Setup& setup, ModalState& state, Parameters& parameters) {
  state.units = units_of(setup);
  if (auto checked = load_axes(setup.start, "start"); !checked) return checked;
  state.position = {in_units(setup.start.linear(Axis::X), state.units),
                    in_units(setup.start.linear(Axis::Z), state.units)};
  state.previous = state.previous_machine = state.position;
  const Position& machine = setup.position.value_or(setup.start);
  if (auto checked = load_axes(machine, "position"); !checked) return checked;
  state.searched_from = {machine.linear(Axis::X).mm(), machine.linear(Axis::Z).mm()};
  if (auto done = load_power_on(setup.control, state, parameters); !done) return done;
  const auto is_diameter = stored_x_is_diameter(setup.control);
  if (!is_diameter) return fail(is_diameter.error());
  if (auto done = load_places(setup, parameters); !done) return done;
  if (auto done = load_machine_parameters(setup.control, parameters); !done) return done;
  for (const OffsetRecord& offset : setup.offsets) {
    if (auto done = load_offset(offset, *is_diameter, state, parameters); !done) return done;
  }
  for (const ToolRecord& tool : setup.tools) {
    if (auto done = load_tool(tool, state.units, parameters); !done) return done;
  }
  for (const VariableRecord& variable : setup.variables) {
    if (auto done = load_variable(variable, parameters); !done) return done;
  }
  return {};
}

}  // namespace dripline::interpreter::centurion
