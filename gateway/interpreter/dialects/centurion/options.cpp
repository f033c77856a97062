#include "gateway/interpreter/dialects/centurion/options.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/option.hpp"
#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"
#include "gateway/interpreter/dialects/centurion/memory/panel_tables.hpp"
#include "gateway/interpreter/dialects/centurion/memory/pins.hpp"

namespace dripline::interpreter::centurion {
namespace {

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

/// What the machine does at M6: its signal, and the spindle.
Result<void> read_tool_change(const Options& options, ControlOptions& control) {
  const auto pin = options.integer("m6_pin", 0);
  if (!pin) return fail(pin.error());
  if (*pin != 0) {
    control.tool_change_pin = static_cast<int>(*pin);
    if (!output_of_pin(*control.tool_change_pin)) {
      return fail(Errc::LimitExceeded,
                  "[control] m6_pin: {} is no output, 1012 to 1023 (Z) or 2012 to 2023 (X)", *pin);
    }
  }
  const auto spindle = options.choice("m6_spindle", {"keep", "stop"}, 0);
  if (!spindle) return fail(spindle.error());
  control.tool_change_stops_spindle = *spindle == 1;
  const auto has_changer = options.flag("tool_changer", false);
  if (!has_changer) return fail(has_changer.error());
  control.has_tool_changer = *has_changer;
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
  if (auto done = read_tool_change(options, control); !done) return done;
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

Result<void> read_start_choices(const Options& options, ControlOptions& control) {
  const auto memory = options.choice("start_memory", {"ask", "begin", "now"}, 0);
  if (!memory) return fail(memory.error());
  control.may_count_again = *memory != 0;
  const auto pass = options.integer("start_pass", 0);
  if (!pass) return fail(pass.error());
  if (*pass == 0) return {};
  if (*pass < 0) return fail(Errc::LimitExceeded, "[control] start_pass: {} is below 1", *pass);
  if (control.start_at->kind == StartAt::Kind::Count)
    return fail(Errc::Syntax, "[control] start_pass: \"{}\" is one time only",
                control.start_at->text);
  control.start_pass = static_cast<std::uint64_t>(*pass);
  return {};
}

Result<void> read_start(const Setup& setup, ControlOptions& control) {
  const Options& options = setup.control;
  constexpr double kUsualFeed = 10;
  const auto feed = options.number("power_on_feed", kUsualFeed);
  if (!feed) return fail(feed.error());
  const bool is_inch = setup.units.value_or(Units::Inch) == Units::Inch;
  control.power_on_feed_mm = is_inch ? Length::inch(*feed).mm() : *feed;
  const auto text = options.text("start_at", "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  auto start = parse_start_at(*text);
  if (!start) return fail(Errc::Syntax, "[control] start_at: {}", start.error().what);
  control.start_at = std::move(*start);
  return read_start_choices(options, control);
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
  control.chamfer = *chamfer == 0 ? blending::Chamfer::Leg : blending::Chamfer::Face;
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
                                    "start_pass",
                                    "start_memory",
                                    "dry_run_feed",
                                    "dry_run_spindle",
                                    "chamfer",
                                    "solver_x",
                                    "feed_overrides",
                                    "spindle_overrides",
                                    "handwheel_pulses",
                                    "cranking_minutes",
                                    "m6_pin",
                                    "m6_spindle",
                                    "tool_changer",
                                    "machine"});
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
                    read_mode(options, control), read_start(setup, control),
                    read_dry_run(options, control), read_geometry(options, control)}) {
    if (!done) return fail(done.error());
  }
  if (const auto tables = read_panel_tables(setup); !tables) return fail(tables.error());
  const auto report = options.text("report_file", "REPORT.DAT");
  if (!report) return fail(report.error());
  control.report_file = report->empty() ? "REPORT.DAT" : *report;
  const auto pulse = options.number("pulse_ms", control.pulse_ms);
  if (!pulse) return fail(pulse.error());
  control.pulse_ms = *pulse;
  Parameters machine;  // read here for its checks and the changer's pockets
  if (auto done = load_machine_parameters(options, machine); !done) return fail(done.error());
  auto pockets = read_pockets(setup, static_cast<int>(machine[kAtcPockets]));
  if (!pockets) return fail(pockets.error());
  control.pockets = *pockets;
  auto pins = options.integers("pins");
  if (!pins) return fail(pins.error());
  control.answers_pins = options.find("pins") != nullptr;
  control.pins_at_one = std::move(*pins);
  return control;
}

}  // namespace dripline::interpreter::centurion
