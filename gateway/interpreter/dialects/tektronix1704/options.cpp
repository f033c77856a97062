#include "gateway/interpreter/dialects/tektronix1704/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace dripline::interpreter::tektronix1704 {
namespace {

constexpr std::array kStepNames{
    std::pair{CycleStep::FeedIn, std::string_view("feed_in")},
    std::pair{CycleStep::PeckIn, std::string_view("peck_in")},
    std::pair{CycleStep::Dwell, std::string_view("dwell")},
    std::pair{CycleStep::SpindleStop, std::string_view("spindle_stop")},
    std::pair{CycleStep::SpindleReverse, std::string_view("spindle_reverse")},
    std::pair{CycleStep::ProgramStop, std::string_view("program_stop")},
    std::pair{CycleStep::FeedOut, std::string_view("feed_out")},
    std::pair{CycleStep::RapidOut, std::string_view("rapid_out")},
    std::pair{CycleStep::ManualOut, std::string_view("manual_out")},
};

/// After EIA RS-326-A (spec 12).
std::array<CycleSteps, 10> standard_cycles() {
  using enum CycleStep;
  return {CycleSteps{},
          {FeedIn, RapidOut},
          {FeedIn, Dwell, RapidOut},
          {PeckIn, RapidOut},
          {FeedIn, SpindleStop, SpindleReverse, FeedOut},
          {FeedIn, FeedOut},
          {FeedIn, SpindleStop, RapidOut},
          {FeedIn, SpindleStop, ProgramStop, ManualOut},
          {FeedIn, Dwell, SpindleStop, ProgramStop, ManualOut},
          {FeedIn, Dwell, FeedOut}};
}

/// The 15 positions of a panel timer: equal steps from 1.3 to 12 seconds.
double timer_seconds(std::int64_t position) {
  constexpr double kFirst = 1.3;
  constexpr double kSpan = 10.7;
  constexpr double kSteps = 14;
  return kFirst + static_cast<double>(position - 1) * kSpan / kSteps;
}

Result<void> read_flags(const Options& options, ControlOptions& control) {
  struct Row {
    std::string_view key;
    bool ControlOptions::*member;
  };
  static constexpr std::array kRows{
      Row{"circular", &ControlOptions::has_arcs},
      Row{"fixed_cycles", &ControlOptions::has_cycles},
      Row{"dwell", &ControlOptions::has_dwell},
      Row{"quill", &ControlOptions::has_quill},
      Row{"spindle_s", &ControlOptions::has_spindle_speed},
      Row{"tool_t", &ControlOptions::has_tool_codes},
      Row{"auto_toolchange", &ControlOptions::has_tool_changer},
      Row{"mist", &ControlOptions::has_mist},
      Row{"strict", &ControlOptions::is_strict},
      Row{"cycle_z_with_xy", &ControlOptions::cycle_z_moves_with_xy},
      Row{"m05_delayed", &ControlOptions::m05_is_delayed},
      Row{"m09_delayed", &ControlOptions::m09_is_delayed},
      Row{"m05_stops_coolant", &ControlOptions::m05_stops_coolant},
      Row{"reader_check", &ControlOptions::checks_reader},
  };
  for (const Row& row : kRows) {
    const auto value = options.flag(row.key, control.*row.member);
    if (!value) return fail(value.error());
    control.*row.member = *value;
  }
  return {};
}

Result<void> read_choices(const Options& options, ControlOptions& control) {
  const auto units = options.choice("units", {"inch", "opt1", "opt2", "metric"}, 0);
  const auto errors = options.choice("errors", {"stop", "skip_block"}, 0);
  const auto arcs = options.choice("arc_policy", {"alarm", "run"}, 0);
  const auto feed = options.choice("opt1_feed", {"tenths", "count_x_0.2"}, 0);
  for (const auto* choice : {&units, &errors, &arcs, &feed}) {
    if (!*choice) return fail(choice->error());
  }
  control.units = static_cast<UnitSet>(*units);
  control.skips_bad_blocks = *errors == 1;
  control.runs_bad_arcs = *arcs == 1;
  control.option1_feed_is_doubled = *feed == 1;
  return {};
}

Result<void> read_rates(const Options& options, ControlOptions& control) {
  const bool is_coarse = control.units == UnitSet::Option2 || control.is_metric();
  const bool is_doubled = control.units == UnitSet::Option1;
  const double least = is_coarse ? 1 : is_doubled ? 0.2 : 0.1;
  const double most = is_coarse ? 2000 : is_doubled ? 400 : 200;
  const double rapid = control.is_metric() ? 4000 : control.units == UnitSet::Option2 ? 2000 : 400;
  struct Row {
    std::string_view key;
    double ControlOptions::*member;
    double fallback;
  };
  for (const Row& row : {Row{"min_feed", &ControlOptions::min_feed, least},
                         Row{"max_feed", &ControlOptions::max_feed, most},
                         Row{"rapid", &ControlOptions::rapid, rapid},
                         Row{"reader_cps", &ControlOptions::reader_characters_per_second, 300}}) {
    const auto value = options.number(row.key, row.fallback);
    if (!value) return fail(value.error());
    if (!(*value > 0)) return fail(Errc::Syntax, "[control] {}: must be above 0", row.key);
    control.*row.member = *value;
  }
  return {};
}

Result<void> read_timers(const Options& options, ControlOptions& control) {
  const auto dwell = options.integer("dwell_timer", 1);
  const auto peck = options.integer("peck_timer", 1);
  for (const auto* position : {&dwell, &peck}) {
    if (!*position) return fail(position->error());
    if (**position < 1 || **position > 15) {
      return fail(Errc::LimitExceeded, "[control] timers have positions 1 to 15, not {}",
                  **position);
    }
  }
  control.dwell_seconds = timer_seconds(*dwell);
  control.peck_seconds = timer_seconds(*peck);
  const auto tolerance = options.integer("arc_tolerance", 5);
  if (!tolerance) return fail(tolerance.error());
  control.arc_tolerance = std::clamp<std::int64_t>(*tolerance, 0, 1000);
  return {};
}

/// A key of two digits: a G, M or S code.
Result<std::size_t> code_of(std::string_view option, std::string_view key) {
  std::size_t code = 100;
  const auto parsed = std::from_chars(key.data(), key.data() + key.size(), code);
  if (parsed.ec != std::errc() || parsed.ptr != key.data() + key.size() || code > 99) {
    return fail(Errc::Syntax, "[control] {}: \"{}\" is not a code of two digits", option, key);
  }
  return code;
}

Result<const OptionTable*> table_of(const Options& options, std::string_view key) {
  static const OptionTable kEmpty;
  const OptionValue* option = options.find(key);
  if (option == nullptr) return &kEmpty;
  if (const auto* table = std::get_if<OptionTable>(&option->value)) return table;
  return fail(Errc::Syntax, "[control] {} (line {}): expected a table", key, option->line);
}

Result<CycleSteps> read_steps(const OptionEntry& entry) {
  const auto* list = std::get_if<OptionList>(&entry.value.value);
  CycleSteps steps;
  for (const OptionValue& value : list ? *list : OptionList{}) {
    const auto* name = std::get_if<std::string>(&value.value);
    const auto row = std::find_if(kStepNames.begin(), kStepNames.end(), [&](const auto& each) {
      return name != nullptr && each.second == *name;
    });
    if (row == kStepNames.end()) {
      return fail(Errc::Syntax, "[control] cycle_table: unknown step in G{}", entry.key);
    }
    steps.push_back(row->first);
  }
  if (list == nullptr || steps.empty() || steps.size() > 16) {
    return fail(Errc::Syntax, "[control] cycle_table: G{} needs a list of 1 to 16 steps",
                entry.key);
  }
  return steps;
}

Result<void> read_tables(const Options& options, ControlOptions& control) {
  control.cycles = standard_cycles();
  const auto cycles = table_of(options, "cycle_table");
  const auto speeds = table_of(options, "spindle_table");
  const auto names = table_of(options, "usermcodes");
  for (const auto* table : {&cycles, &speeds, &names}) {
    if (!*table) return fail(table->error());
  }
  for (const OptionEntry& entry : **cycles) {
    const auto code = code_of("cycle_table", entry.key);
    if (!code) return fail(code.error());
    if (*code < 81 || *code > 89) {
      return fail(Errc::LimitExceeded, "[control] cycle_table: {} is not 81 to 89", *code);
    }
    auto steps = read_steps(entry);
    if (!steps) return fail(steps.error());
    control.cycles[*code - 80] = std::move(*steps);
  }
  for (const OptionEntry& entry : **speeds) {
    const auto code = code_of("spindle_table", entry.key);
    if (!code) return fail(code.error());
    const auto* whole = std::get_if<std::int64_t>(&entry.value.value);
    const auto* real = std::get_if<double>(&entry.value.value);
    if (whole == nullptr && real == nullptr) {
      return fail(Errc::Syntax, "[control] spindle_table: S{} needs a number", entry.key);
    }
    control.spindle_speed[*code] = whole != nullptr ? static_cast<double>(*whole) : *real;
  }
  for (const OptionEntry& entry : **names) {
    const auto code = code_of("usermcodes", entry.key);
    if (!code) return fail(code.error());
    const auto* name = std::get_if<std::string>(&entry.value.value);
    if (name == nullptr) return fail(Errc::Syntax, "[control] usermcodes: M{}: text", entry.key);
    control.m_names[*code] = *name;
  }
  return {};
}

std::int64_t counts(const ControlOptions& control, Length length) {
  return std::llround(length.mm() / control.mm_per_count());
}

Result<void> read_positions(const Setup& setup, ControlOptions& control) {
  const auto zero = setup.control.position("zero");
  const auto low = setup.control.position("travel_low");
  const auto high = setup.control.position("travel_high");
  for (const auto* position : {&zero, &low, &high}) {
    if (!*position) return fail(position->error());
  }
  for (std::size_t i = 0; i < kAxes; ++i) {
    const auto axis = static_cast<Axis>(i);
    control.start[i] = counts(control, setup.start.linear(axis));
    control.zero[i] = counts(control, zero->linear(axis));
    if (low->has(axis)) control.travel[i].low = counts(control, low->linear(axis));
    if (high->has(axis)) control.travel[i].high = counts(control, high->linear(axis));
  }
  return {};
}

Result<void> read_mirror(const Setup& setup, ControlOptions& control) {
  const auto fitted = setup.control.text("mirror", "XYZ");
  if (!fitted) return fail(fitted.error());
  for (const Axis axis : setup.switches.mirror) {
    const auto index = static_cast<std::size_t>(axis);
    if (index >= control.axes || fitted->find(letter(axis)) == std::string::npos) {
      return fail(Errc::Unsupported, "mirror: this control has no switch for axis {}",
                  letter(axis));
    }
    control.mirror[index] = true;
  }
  return {};
}

Result<void> read_start(const Options& options, ControlOptions& control) {
  const auto axes = options.integer("axes", 3);
  if (!axes) return fail(axes.error());
  if (*axes != 2 && *axes != 3) {
    return fail(Errc::LimitExceeded, "[control] axes: {} is neither 2 nor 3", *axes);
  }
  control.axes = static_cast<std::size_t>(*axes);
  const auto search = options.integer("search", -1);
  if (!search) return fail(search.error());
  if (*search > 999) {
    return fail(Errc::LimitExceeded, "[control] search: {} is over 999", *search);
  }
  if (*search >= 0) control.search = static_cast<int>(*search);
  const OptionValue* mdi = options.find("mdi");
  const auto* list = mdi != nullptr ? std::get_if<OptionList>(&mdi->value) : nullptr;
  if (mdi != nullptr && list == nullptr)
    return fail(Errc::Syntax, "[control] mdi: expected a list");
  for (const OptionValue& value : list != nullptr ? *list : OptionList{}) {
    const auto* block = std::get_if<std::string>(&value.value);
    if (block == nullptr || block->size() > 200) {
      return fail(Errc::Syntax, "[control] mdi: expected blocks as text, up to 200 characters");
    }
    control.mdi.push_back(*block);
  }
  return {};
}

}  // namespace

double ControlOptions::mm_per_count() const {
  switch (units) {
    case UnitSet::Option2:
      return Length::inch(0.001).mm();
    case UnitSet::Metric:
      return 0.001;
    default:
      return Length::inch(0.0001).mm();
  }
}

Result<ControlOptions> read_options(const Setup& setup) {
  const Options& options = setup.control;
  const auto known = options.check_known({"axes",
                                          "units",
                                          "circular",
                                          "fixed_cycles",
                                          "cycle_table",
                                          "dwell",
                                          "quill",
                                          "spindle_s",
                                          "spindle_table",
                                          "tool_t",
                                          "auto_toolchange",
                                          "mist",
                                          "mirror",
                                          "reader_cps",
                                          "reader_check",
                                          "max_feed",
                                          "min_feed",
                                          "rapid",
                                          "travel_low",
                                          "travel_high",
                                          "usermcodes",
                                          "opt1_feed",
                                          "arc_policy",
                                          "arc_tolerance",
                                          "errors",
                                          "strict",
                                          "cycle_z_with_xy",
                                          "m05_delayed",
                                          "m09_delayed",
                                          "m05_stops_coolant",
                                          "dwell_timer",
                                          "peck_timer",
                                          "mdi",
                                          "search",
                                          "zero"});
  if (!known) return fail(known.error());
  ControlOptions control;
  control.optional_stop = setup.switches.optional_stop;
  for (const auto& read :
       {read_start, read_flags, read_choices, read_rates, read_timers, read_tables}) {
    if (auto done = read(options, control); !done) return fail(done.error());
  }
  if (auto done = read_positions(setup, control); !done) return fail(done.error());
  if (auto done = read_mirror(setup, control); !done) return fail(done.error());
  return control;
}

}  // namespace dripline::interpreter::tektronix1704
