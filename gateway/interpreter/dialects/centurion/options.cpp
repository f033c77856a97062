#include "gateway/interpreter/dialects/centurion/options.hpp"

#include <algorithm>

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"
#include "gateway/interpreter/dialects/centurion/memory/panel_tables.hpp"
#include "gateway/interpreter/dialects/centurion/memory/pins.hpp"

namespace dripline::interpreter::centurion {
namespace {

using Control = ControlOptions;
using Row = OptionRow<Control>;

/// One number for both units, or [inch, metric].
template <std::array<int, 2> Control::*kMember>
Result<void> read_digits(const Options& options, const OptionKey& key, Control& control) {
  const auto values = options.integers(key.key);
  if (!values) return fail(values.error());
  if (values->empty()) return {};
  const bool is_sane = std::all_of(values->begin(), values->end(), [&](std::int64_t value) {
    return key.range.contains(static_cast<double>(value));
  });
  if (values->size() > 2 || !is_sane) {
    return fail(Errc::Syntax, "[control] {}: expected 0 to 9, or two of them for inch and metric",
                key.key);
  }
  control.*kMember = {static_cast<int>(values->front()), static_cast<int>(values->back())};
  return {};
}

/// With `resolve_dnc`, GOTO runs all the same.
Result<void> read_dnc_refusals(const Options& options, const OptionKey& key, Control& control) {
  const auto refuses = options.flag(key.key, false);
  if (!refuses) return fail(refuses.error());
  const auto resolves = options.flag("resolve_dnc", true);
  if (!resolves) return fail(resolves.error());
  control.refuses_loops_and_calls = *refuses;
  control.refuses_goto = *refuses && !*resolves;
  return {};
}

Result<void> read_dry_run_feed(const Options& options, const OptionKey& key, Control& control) {
  const auto feed = options.length(key.key, Length::inch(75));
  if (!feed) return fail(feed.error());
  control.dry_run_feed_mm = feed->mm();
  return check_range(key, feed->mm());
}

Result<void> read_spindle_ranges(const Options& options, const OptionKey& key, Control& control) {
  const auto max = read_integers(options, key);
  if (!max) return fail(max.error());
  if (max->empty()) return {};
  if (max->size() != control.spindle_ranges.size()) {
    return fail(Errc::Syntax, "[control] spindle_ranges: expected low, medium and high");
  }
  std::copy(max->begin(), max->end(), control.spindle_ranges.begin());
  return {};
}

/// Codes in the order of the programs they call; 0 leaves a program out.
template <std::array<int, 10> Control::*kMember>
Result<void> read_custom(const Options& options, const OptionKey& key, Control& control) {
  const auto codes = read_integers(options, key);
  if (!codes) return fail(codes.error());
  for (std::size_t i = 0; i < codes->size(); ++i) {
    (control.*kMember)[i] = static_cast<int>((*codes)[i]);
    control.has_custom_codes |= (*codes)[i] != 0;
  }
  return {};
}

Result<void> read_post_codes(const Options& options, const OptionKey& key, Control& control) {
  const auto codes = read_integers(options, key);
  if (!codes) return fail(codes.error());
  for (const std::int64_t code : *codes) {
    if (code != 0) control.post_m.push_back(static_cast<int>(code));
  }
  return {};
}

Result<void> read_change_pin(const Options& options, const OptionKey& key, Control& control) {
  const auto pin = options.integer(key.key, 0);
  if (!pin) return fail(pin.error());
  if (*pin == 0) return {};
  control.tool_change_pin = static_cast<int>(*pin);
  if (output_of_pin(*control.tool_change_pin)) return {};
  return fail(Errc::Syntax,
              "[control] m6_pin: {} is no output, 1012 to 1023 (Z) or 2012 to 2023 (X)", *pin);
}

Result<void> read_mode(const Options& options, const OptionKey& key, Control& control) {
  const auto mode = read_word(options, key, 0);
  if (!mode) return fail(mode.error());
  control.is_verify = *mode == 1;
  control.is_mdi = *mode == 2;
  return {};
}

Result<void> read_dnc_mode(const Options& options, const OptionKey& key, Control& control) {
  const auto mode = read_word(options, key, 0);
  if (!mode) return fail(mode.error());
  control.is_dnc_fast = *mode == 2;
  return {};
}

Result<void> read_start_at(const Options& options, const OptionKey& key, Control& control) {
  const auto text = options.text(key.key, "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  auto start = parse_start_at(*text);
  if (!start) return fail(Errc::Syntax, "[control] start_at: {}", start.error().what);
  control.start_at = std::move(*start);
  return {};
}

/// Without a start elsewhere there is nothing that it chooses.
Result<void> read_start_pass(const Options& options, const OptionKey& key, Control& control) {
  const auto pass = options.integer(key.key, 0);
  if (!pass) return fail(pass.error());
  if (auto good = check_range(key, static_cast<double>(*pass)); !good) return good;
  if (*pass == 0 || !control.start_at) return {};
  if (control.start_at->kind == StartAt::Kind::Count) {
    return fail(Errc::Syntax, "[control] start_pass: \"{}\" is one time only",
                control.start_at->text);
  }
  control.start_pass = static_cast<std::uint64_t>(*pass);
  return {};
}

Result<void> read_start_memory(const Options& options, const OptionKey& key, Control& control) {
  const auto memory = read_word(options, key, 0);
  if (!memory) return fail(memory.error());
  control.may_count_again = control.start_at && *memory != 0;
  return {};
}

Result<void> read_report_file(const Options& options, const OptionKey& key, Control& control) {
  const auto name = options.text(key.key, "");
  if (!name) return fail(name.error());
  control.report_file = name->empty() ? key.fallback : std::string_view(*name);
  return {};
}

/// A row that control_memory.cpp reads into the parameters.
constexpr Row place(std::string_view key, std::string_view text,
                    std::string_view fallback = "0 on every axis") {
  return {{key, kAxisTable, text, fallback}};
}

// A row that others depend on is above them: start_at.
constexpr std::array kOptionRows{
    Row{{"stored_x", "radius|diameter", "what X is in [control] and [[offset]]"}},
    // POWER page
    Row{{"power_on_feed", kNumber, "feed in force at power on", "10", {}, "per min or rev"}},
    Row{{"power_on_feed_mode", "per_min|per_rev", "unit of that feed", "per_rev"}},
    row<&Control::tool_change_program>("m6_macro", kWhole, "program that M6 calls; 0: none",
                                       {0, 9999}),
    Row{{"m6_pin", kWhole, "output that M6 pulses, by its pin; 0: none", "0"}, read_change_pin},
    row<&Control::tool_change_stops_spindle>("m6_spindle", "keep|stop",
                                             "what M6 does with a running spindle"),
    row<&Control::has_tool_changer>("tool_changer", kFlag,
                                    "true: M6 does not wait until the operator has changed"),
    Row{{"custom_g", kWholes, "G codes that call O9010 to O9019; 0: none", "", {0, 999, false, 10}},
        read_custom<&Control::custom_g>},
    Row{option("custom_m", kWholes, "M codes that call O9020 to O9029; 0: none", "",
               {0, kHighestM, false, 10}),
        read_custom<&Control::custom_m>},
    row<&Control::dry_run_turns_spindle>("dry_run_spindle", kFlag, "the spindle runs in a dry run"),
    // AXIS pages
    place("home", "coordinates of the home point"),
    place("positive_limit", "positive end of travel from machine zero; both ends 0: no limits"),
    place("negative_limit", "negative end of travel"),
    place("maximum_feed", "highest feed per minute, whatever the override", "no limit"),
    Row{{"dry_run_feed", kFeed, "feed of a dry run", "75 in/min", kPositive}, read_dry_run_feed},
    place("g0_overrun", "approach of G0 from one side"),
    place("g60_overrun", "approach of G60 from one side"),
    place("tool_change", "tool change point of G47, G48 and M6"),
    Row{{"leading", kWholes, "digits before the point that PRINT shows: inch, metric", "0", {0, 9}},
        read_digits<&Control::leading_digits>},
    Row{option("trailing", kWholes, "digits after the point that PRINT shows: inch, metric", "4, 3",
               {0, 9}),
        read_digits<&Control::trailing_digits>},
    // MISC page
    Row{option("special_flags", kWhole,
               "sum of 1: tool circle, 2: Trig Help off, 4: nose compensation off", "0", {0, 255})},
    Row{option("spindle_ranges", kWholes, "highest speed in the low, medium and high range",
               "9999, 9999, 9999", {1, 9999}, "rpm"),
        read_spindle_ranges},
    Row{{"spindle_range", "low|medium|high", "range in force at the start"}},
    row<&Control::tap_ramp_seconds>(
        "tap_ramp", kNumber, "time of the spindle from full speed to standstill", {0, 60}, "s"),
    Row{{"post_m", kWholes, "M codes that act last in their block", "", {0, kHighestM, false, 10}},
        read_post_codes},
    row<&Control::interlocks_coolant>("coolant_interlock", kFlag,
                                      "coolant runs only while the spindle runs"),
    Row{option("cranking_minutes", kNumber,
               "program time of one revolution of the handwheel that drives a program", "0.001",
               {0, 1, true}, "min")},
    Row{{"report_file", kText, "file of DPRNT after POPEN P0", "REPORT.DAT"}, read_report_file},
    row<&Control::pulse_ms>("pulse_ms", kNumber, "length of PULSE0 and PULSE1", {}, "ms"),
    Row{{"resolve_dnc", kFlag, "GOTO runs in a DNC run despite dnc_refusals", "true"}},
    // Override tables
    Row{option("feed_overrides", kWholes,
               "feed override of each of up to 16 positions of the switch", "0, 10, 20 ... 150",
               {0, 199}, "%")},
    Row{option("spindle_overrides", kWholes,
               "spindle override of each of up to 16 positions of the switch",
               "0, 10, 20 ... 130, 175", {0, 255}, "%")},
    Row{option("handwheel_pulses", kWholes,
               "pulses of a click of the handwheel, for each position of the feed switch",
               "0, 1, 2 ... 15", {0, 255})},
    // COORD page
    Row{{"reference", kAxisTables, "reference points of G28, then of G30 P2, P3, P4",
         "0 on every axis"}},
    place("positive_zone", "upper corner of the safe zone of G22"),
    place("negative_zone", "lower corner of the safe zone of G22"),
    // Panel and start
    Row{{"mode", "run|verify|mdi", "mode of the panel"}, read_mode},
    Row{{"start_at", kText,
         "where a run begins: N120, T3 (tool), L40 (line), B4096 (byte), +25 (blocks, as "
         "executed)",
         "the first block"},
        read_start_at},
    Row{option("start_pass", kWhole,
               "which time the program comes to start_at; 0: it must come there once", "0",
               {.low = 0}),
        read_start_pass},
    Row{{"start_memory", "ask|begin|now",
         "memory that the part before start_at reads: as the run began, or as it is now"},
        read_start_memory},
    // DNC, and what the manual leaves open
    Row{{"dnc_mode", "none|run|fast", "fast: refuses what that mode refuses"}, read_dnc_mode},
    Row{{"dnc_refusals", kFlag, "refuses loops and calls in a DNC run, as the control does",
         "false"},
        read_dnc_refusals},
    row<&Control::spindle_check>("cycle_spindle", "ignore|warn|alarm",
                                 "what a cycle does while the spindle is stopped"),
    row<&Control::groove_relief_goes_on>(
        "groove_relief", "back|on", "G74, G75 back off against their steps, or in their direction"),
    row<&Control::chamfer>("chamfer", "leg|face", "what the size of ,C is"),
    row<&Control::solver_x_is_radius>("solver_x", "diameter|radius",
                                      "what X is in the points of TANL, TANA and CGEN"),
    row<&Control::asks_for_inputs>("ask_inputs", kFlag, "waits for inputs ask the operator"),
    Row{{"disable_417", kFlag, "no effect", "false"}, check_option<Control>},
    pins_row<&Control::pins_at_one, &Control::answers_pins>(),
    Row{{"machine", "table",
         "the other parameters of the AXIS and POWER pages, [control.machine]"}},
};

}  // namespace

std::vector<ListedOption> list_options() {
  return list_rows(kOptionRows);
}

Result<ControlOptions> read_options(const Setup& setup) {
  ControlOptions control;
  if (auto done = read_rows(kOptionRows, setup.control, control); !done) return fail(done.error());
  if (!setup.switches.mirror.empty()) {
    return fail(Errc::Unsupported, "switches.mirror: this control mirrors with G511");
  }
  control.block_skip = setup.switches.block_skip;
  control.optional_stop = setup.switches.optional_stop;
  control.single_block = setup.switches.single_block;
  control.is_dry_run = setup.switches.dry_run;
  control.is_mdi |= setup.is_mdi;
  const auto feed = setup.control.number("power_on_feed", 10);
  if (!feed) return fail(feed.error());
  const bool is_inch = setup.units.value_or(Units::Inch) == Units::Inch;
  control.power_on_feed_mm = is_inch ? Length::inch(*feed).mm() : *feed;
  if (const auto tables = read_panel_tables(setup); !tables) return fail(tables.error());
  Parameters machine;  // read here for its checks and the changer's pockets
  if (auto done = load_machine_parameters(setup.control, machine); !done) return fail(done.error());
  auto pockets = read_pockets(setup, static_cast<int>(machine[kAtcPockets]));
  if (!pockets) return fail(pockets.error());
  control.pockets = *pockets;
  return control;
}

}  // namespace dripline::interpreter::centurion
