#include "gateway/interpreter/centurion/options.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/centurion/m_codes.hpp"
#include "gateway/interpreter/option.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::interpreter::centurion {
namespace {

Units units_of(const Setup& setup) {
  return setup.units.value_or(Units::Inch);
}

double in_units(Length length, Units units) {
  return units == Units::Inch ? length.inch() : length.mm();
}

/// One number for both units, or [inch, metric].
Result<void> read_digits(const Options& options, std::string_view name,
                         std::array<int, 2>& digits) {
  const auto values = options.integers(name);
  if (!values) return fail(values.error());
  if (values->empty()) return {};
  const bool is_sane = std::all_of(values->begin(), values->end(),
                                   [](std::int64_t value) { return value >= 0 && value <= 9; });
  if (values->size() > 2 || !is_sane) {
    return fail(Errc::Syntax, "[control] {}: expected 0 to 9, or two of them for inch and metric",
                name);
  }
  digits = {static_cast<int>(values->front()), static_cast<int>(values->back())};
  return {};
}

Result<void> read_dnc(const Options& options, ControlOptions& control) {
  const auto refuses = options.flag("dnc_refusals", false);
  const auto resolves = options.flag("resolve_dnc", true);
  if (!refuses) return fail(refuses.error());
  if (!resolves) return fail(resolves.error());
  control.refuses_loops_and_calls = *refuses;
  control.refuses_goto = *refuses && !*resolves;
  return {};
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

/// A place of the machine into P`first` (Z) and the one behind it (X).
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

struct PlaceOption {
  std::string_view name;
  int parameter;
};
constexpr PlaceOption kPlaceOptions[] = {
    {"home", kHomePosition},
    {"tool_change", kToolChangePoint},
    {"positive_zone", kPositiveZone},
    {"negative_zone", kNegativeZone},
    {"positive_limit", kPositiveLimit},
    {"negative_limit", kNegativeLimit},
    {"g60_overrun", kSingleOverrun},
    {"g0_overrun", kRapidOverrun},
    {"maximum_feed", kMaximumFeed},
};

bool is_zero(const OptionValue& option) {
  const auto* number = std::get_if<std::int64_t>(&option.value);
  return number != nullptr && *number == 0;
}

/// The axis parameters and reference points (spec 23.1, 23.4). A plain 0 leaves all axes at 0.
Result<void> load_places(const Setup& setup, Parameters& parameters) {
  constexpr std::size_t kMostReferences = 4;
  const Options& options = setup.control;
  for (const PlaceOption& option : kPlaceOptions) {
    const OptionValue* value = options.find(option.name);
    if (value == nullptr || is_zero(*value)) continue;
    const auto place = options.position(option.name);
    if (!place) return fail(place.error());
    auto loaded = load_place(*place, option.name, option.parameter, setup, parameters);
    if (!loaded) return loaded;
    // a feed is no position: always of the radius
    if (option.parameter == kMaximumFeed) {
      parameters[kMaximumFeed + 1] = in_units(place->linear(Axis::X), units_of(setup));
    }
  }
  const OptionValue* value = options.find("reference");
  if (value == nullptr || is_zero(*value)) return {};
  const auto points = options.positions("reference");
  if (!points) return fail(points.error());
  if (points->size() > kMostReferences) {
    return fail(Errc::LimitExceeded, "[control] reference: {} points, this control has {}",
                points->size(), kMostReferences);
  }
  for (std::size_t i = 0; i < points->size(); ++i) {
    const int first = kReferencePoints + 2 * static_cast<int>(i);
    auto loaded = load_place((*points)[i], "reference", first, setup, parameters);
    if (!loaded) return loaded;
  }
  return {};
}

/// `spindle_ranges`: the most revolutions of low, medium and high; `spindle_range` at the start.
Result<void> read_spindle(const Options& options, ControlOptions& control) {
  const auto most = options.integers("spindle_ranges");
  if (!most) return fail(most.error());
  if (!most->empty() && most->size() != control.spindle_ranges.size()) {
    return fail(Errc::Syntax, "[control] spindle_ranges: expected low, medium and high");
  }
  for (std::size_t i = 0; i < most->size(); ++i) {
    if ((*most)[i] < 1 || (*most)[i] > 9999) {
      return fail(Errc::LimitExceeded, "[control] spindle_ranges: {} is not 1 to 9999", (*most)[i]);
    }
    control.spindle_ranges[i] = static_cast<double>((*most)[i]);
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

/// Feed, special flags and the other things of power-on.
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

/// Up to ten codes, in the order of the programs they are bound to; 0 leaves one out.
Result<void> read_custom(const Options& options, std::string_view name, std::int64_t highest,
                         std::array<int, 10>& codes) {
  const auto values = options.integers(name);
  if (!values) return fail(values.error());
  const bool is_sane = std::all_of(values->begin(), values->end(), [highest](std::int64_t value) {
    return value >= 0 && value <= highest;
  });
  if (values->size() > codes.size() || !is_sane) {
    return fail(Errc::Syntax, "[control] {}: expected up to {} codes from 1 to {}, 0 for none",
                name, codes.size(), highest);
  }
  std::copy(values->begin(), values->end(), codes.begin());
  return {};
}

Result<void> read_machine_codes(const Options& options, ControlOptions& control) {
  constexpr std::int64_t kHighestProgram = 9999;
  if (auto done = read_custom(options, "custom_g", 999, control.custom_g); !done) return done;
  if (auto done = read_custom(options, "custom_m", kHighestM, control.custom_m); !done) return done;
  const auto is_bound = [](int code) { return code != 0; };
  control.has_custom_codes =
      std::any_of(control.custom_g.begin(), control.custom_g.end(), is_bound) ||
      std::any_of(control.custom_m.begin(), control.custom_m.end(), is_bound);
  std::array<int, 10> post{};
  if (auto done = read_custom(options, "post_m", kHighestM, post); !done) return done;
  for (const int code : post) {
    if (code != 0) control.post_m.push_back(code);
  }
  const auto program = options.integer("m6_macro", 0);
  if (!program) return fail(program.error());
  if (*program < 0 || *program > kHighestProgram) {
    return fail(Errc::LimitExceeded, "[control] m6_macro: {} is not 0 to {}", *program,
                kHighestProgram);
  }
  control.tool_change_program = static_cast<std::uint16_t>(*program);
  const auto interlock = options.flag("coolant_interlock", false);
  if (!interlock) return fail(interlock.error());
  control.interlocks_coolant = *interlock;
  const auto asks = options.flag("ask_inputs", false);
  if (!asks) return fail(asks.error());
  control.asks_for_inputs = *asks;
  return {};
}

Result<void> read_mode(const Options& options, ControlOptions& control) {
  const auto mode = options.choice("mode", {"run", "verify", "mdi"}, 0);
  if (!mode) return fail(mode.error());
  control.is_verify = *mode == 1;
  control.is_mdi = *mode == 2;
  const auto dnc = options.choice("dnc_mode", {"none", "run", "fast"}, 0);
  if (!dnc) return fail(dnc.error());
  control.is_dnc_fast = *dnc == 2;
  return {};
}

Result<void> read_start(const Options& options, ControlOptions& control) {
  const auto text = options.text("start_at", "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  auto start = parse_start_at(*text);
  if (!start) return fail(Errc::Syntax, "[control] start_at: {}", start.error().what);
  control.start_at = std::move(*start);
  return {};
}

Result<void> read_dry_run(const Options& options, ControlOptions& control) {
  constexpr double kUsualFeed = 75;  // inches per minute
  const auto feed = options.length("dry_run_feed", Length::inch(kUsualFeed));
  if (!feed) return fail(feed.error());
  if (!(feed->mm() > 0)) return fail(Errc::LimitExceeded, "[control] dry_run_feed: not above 0");
  control.dry_run_feed_mm = feed->mm();
  const auto turns = options.flag("dry_run_spindle", false);
  if (!turns) return fail(turns.error());
  control.dry_run_turns_spindle = *turns;
  return {};
}

Result<void> read_cycles(const Options& options, ControlOptions& control) {
  const auto check = options.choice("cycle_spindle", {"ignore", "warn", "alarm"}, 1);
  if (!check) return fail(check.error());
  control.spindle_check = static_cast<SpindleCheck>(*check);
  const auto relief = options.choice("groove_relief", {"back", "on"}, 0);
  if (!relief) return fail(relief.error());
  control.groove_relief_goes_on = *relief == 1;
  const auto ramp = options.number("tap_ramp", 0);
  if (!ramp) return fail(ramp.error());
  if (!(*ramp >= 0 && *ramp <= 60)) {
    return fail(Errc::LimitExceeded, "[control] tap_ramp: {} is not 0 to 60 seconds", *ramp);
  }
  control.tap_ramp_seconds = *ramp;
  return {};
}

Result<void> read_geometry(const Options& options, ControlOptions& control) {
  const auto chamfer = options.choice("chamfer", {"leg", "face"}, 0);
  if (!chamfer) return fail(chamfer.error());
  control.chamfer = *chamfer == 0 ? joining::Chamfer::Leg : joining::Chamfer::Face;
  const auto solver_x = options.choice("solver_x", {"diameter", "radius"}, 0);
  if (!solver_x) return fail(solver_x.error());
  control.solver_x_is_radius = *solver_x == 1;
  return {};
}

}  // namespace

Result<ControlOptions> read_options(const Setup& setup) {
  const Options& options = setup.control;
  auto known = options.check_known({"stored_x",
                                    "reference",
                                    "tool_change",
                                    "power_on_feed",
                                    "power_on_feed_mode",
                                    "special_flags",
                                    "leading",
                                    "trailing",
                                    "report_file",
                                    "custom_g",
                                    "custom_m",
                                    "resolve_dnc",
                                    "dnc_refusals",
                                    "pins",
                                    "disable_417",
                                    "pulse_ms",
                                    "home",
                                    "positive_zone",
                                    "negative_zone",
                                    "positive_limit",
                                    "negative_limit",
                                    "g60_overrun",
                                    "g0_overrun",
                                    "maximum_feed",
                                    "spindle_ranges",
                                    "spindle_range",
                                    "cycle_spindle",
                                    "tap_ramp",
                                    "groove_relief",
                                    "m6_macro",
                                    "post_m",
                                    "coolant_interlock",
                                    "ask_inputs",
                                    "mode",
                                    "dnc_mode",
                                    "start_at",
                                    "dry_run_feed",
                                    "dry_run_spindle",
                                    "chamfer",
                                    "solver_x"});
  if (!known) return fail(known.error());
  if (!setup.switches.mirror.empty()) {
    return fail(Errc::Unsupported, "switches.mirror: this control mirrors with G511");
  }
  ControlOptions control;
  control.block_skip = setup.switches.block_skip;
  control.optional_stop = setup.switches.optional_stop;
  control.single_block = setup.switches.single_block;
  control.is_dry_run = setup.switches.dry_run;
  for (auto done : {read_digits(options, "leading", control.leading_digits),
                    read_digits(options, "trailing", control.trailing_digits),
                    read_dnc(options, control), read_spindle(options, control),
                    read_cycles(options, control), read_machine_codes(options, control),
                    read_mode(options, control), read_start(options, control),
                    read_dry_run(options, control), read_geometry(options, control)}) {
    if (!done) return fail(done.error());
  }
  const auto report = options.text("report_file", "REPORT.DAT");
  if (!report) return fail(report.error());
  control.report_file = report->empty() ? "REPORT.DAT" : *report;
  const auto pulse = options.number("pulse_ms", control.pulse_ms);
  if (!pulse) return fail(pulse.error());
  control.pulse_ms = *pulse;
  auto pins = options.integers("pins");
  if (!pins) return fail(pins.error());
  control.answers_pins = options.find("pins") != nullptr;
  control.pins_at_one = std::move(*pins);
  return control;
}

Result<void> load_memory(const Setup& setup, ModalState& state, Parameters& parameters) {
  state.units = units_of(setup);
  if (auto checked = load_axes(setup.start, "start"); !checked) return checked;
  state.position = {in_units(setup.start.linear(Axis::X), state.units),
                    in_units(setup.start.linear(Axis::Z), state.units)};
  state.previous = state.position;
  state.searched_from = {setup.start.linear(Axis::X).mm(), setup.start.linear(Axis::Z).mm()};
  if (auto done = load_power_on(setup.control, state, parameters); !done) return done;
  const auto is_diameter = stored_x_is_diameter(setup.control);
  if (!is_diameter) return fail(is_diameter.error());
  if (auto done = load_places(setup, parameters); !done) return done;
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
