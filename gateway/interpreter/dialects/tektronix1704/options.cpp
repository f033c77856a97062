#include "gateway/interpreter/dialects/tektronix1704/options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "gateway/interpreter/core/option_rows.hpp"

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

/// After EIA RS-326-A.
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

using C = ControlOptions;
using Row = OptionRow<C>;

/// The feed limits follow from the unit of F.
Result<void> read_units(const Options& options, const OptionKey& key, C& control) {
  const auto units = read_word(options, key, 0);
  if (!units) return fail(units.error());
  control.units = static_cast<UnitSet>(*units);
  const bool is_coarse = control.units == UnitSet::Option2 || control.is_metric();
  const bool is_doubled = control.units == UnitSet::Option1;
  control.min_feed = is_coarse ? 1 : is_doubled ? 0.2 : 0.1;
  control.max_feed = is_coarse ? 2000 : is_doubled ? 400 : 200;
  control.rapid = control.is_metric() ? 4000 : control.units == UnitSet::Option2 ? 2000 : 400;
  return {};
}

template <double C::*kSeconds>
Result<void> read_timer(const Options& options, const OptionKey& key, C& control) {
  const auto position = options.integer(key.key, 1);
  if (!position) return fail(position.error());
  if (auto good = check_range(key, static_cast<double>(*position)); !good) return good;
  control.*kSeconds = timer_seconds(*position);
  return {};
}

Result<void> read_search(const Options& options, const OptionKey& key, C& control) {
  const auto number = options.integer(key.key, -1);
  if (!number) return fail(number.error());
  if (*number > 999) return fail(Errc::Syntax, "[control] search: {} is over 999", *number);
  if (*number >= 0) control.search = static_cast<int>(*number);
  return {};
}

/// A start at a gateway: the tape search of the panel, from the beginning of the tape.
Result<void> read_start_at(const Options& options, const OptionKey& key, C& control) {
  const auto text = options.text(key.key, "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  const char* const end = text->data() + text->size();
  int number = -1;
  if (text->front() == 'N') {
    const auto read = std::from_chars(text->data() + 1, end, number);
    if (read.ec != std::errc{} || read.ptr != end) number = -1;
  }
  if (number < 0 || number > 999) {
    return fail(
        Errc::Syntax,
        "[control] start_at: \"{}\" is no sequence number of this control: it goes to N0 to "
        "N999",
        *text);
  }
  control.search = number;
  control.stops_at_search = true;
  return {};
}

Result<void> read_arc_tolerance(const Options& options, const OptionKey& key, C& control) {
  const auto tolerance = options.integer(key.key, control.arc_tolerance);
  if (!tolerance) return fail(tolerance.error());
  control.arc_tolerance = std::clamp<std::int64_t>(*tolerance, 0, 1000);
  return {};
}

Result<void> read_mdi(const Options& options, const OptionKey& key, C& control) {
  constexpr std::size_t kMaxBlock = 200;
  const OptionValue* mdi = options.find(key.key);
  if (mdi == nullptr) return {};
  const auto* list = std::get_if<OptionList>(&mdi->value);
  if (list == nullptr) return fail(Errc::Syntax, "[control] mdi: expected a list");
  for (const OptionValue& value : *list) {
    const auto* block = std::get_if<std::string>(&value.value);
    if (block == nullptr || block->size() > kMaxBlock) {
      return fail(Errc::Syntax, "[control] mdi: expected blocks as text, up to {} characters",
                  kMaxBlock);
    }
    control.mdi.push_back(*block);
  }
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

Result<void> read_cycle_table(const Options& options, const OptionKey& key, C& control) {
  control.cycles = standard_cycles();
  const auto table = table_of(options, key.key);
  if (!table) return fail(table.error());
  for (const OptionEntry& entry : **table) {
    const auto code = code_of(key.key, entry.key);
    if (!code) return fail(code.error());
    if (*code < 81 || *code > 89) {
      return fail(Errc::Syntax, "[control] cycle_table: {} is not 81 to 89", *code);
    }
    auto steps = read_steps(entry);
    if (!steps) return fail(steps.error());
    control.cycles[*code - 80] = std::move(*steps);
  }
  return {};
}

Result<void> read_spindle_table(const Options& options, const OptionKey& key, C& control) {
  const auto table = table_of(options, key.key);
  if (!table) return fail(table.error());
  for (const OptionEntry& entry : **table) {
    const auto code = code_of(key.key, entry.key);
    if (!code) return fail(code.error());
    const auto* whole = std::get_if<std::int64_t>(&entry.value.value);
    const auto* real = std::get_if<double>(&entry.value.value);
    if (whole == nullptr && real == nullptr) {
      return fail(Errc::Syntax, "[control] spindle_table: S{} needs a number", entry.key);
    }
    control.spindle_speed[*code] = whole != nullptr ? static_cast<double>(*whole) : *real;
  }
  return {};
}

Result<void> read_m_names(const Options& options, const OptionKey& key, C& control) {
  const auto table = table_of(options, key.key);
  if (!table) return fail(table.error());
  for (const OptionEntry& entry : **table) {
    const auto code = code_of(key.key, entry.key);
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

Result<void> read_zero(const Options& options, const OptionKey& key, C& control) {
  const auto zero = options.position(key.key);
  if (!zero) return fail(zero.error());
  for (std::size_t i = 0; i < kAxes; ++i) {
    control.zero[i] = counts(control, zero->linear(static_cast<Axis>(i)));
  }
  return {};
}

template <std::optional<std::int64_t> AxisLimits::*kEnd>
Result<void> read_travel(const Options& options, const OptionKey& key, C& control) {
  const auto end = options.position(key.key);
  if (!end) return fail(end.error());
  for (std::size_t i = 0; i < kAxes; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (end->has(axis)) control.travel[i].*kEnd = counts(control, end->linear(axis));
  }
  return {};
}

// `units` is above the rows that depend on it.
constexpr std::array kRows{
    row<&C::axes>("axes", kWhole, "2: X and Y; 3: also Z", {2, 3}),
    Row{{"units", "inch|opt1|opt2|metric",
         "unit of a count: 0.0001 in, 0.0002 in, 0.001 in, 0.001 mm"},
        read_units},
    row<&C::option1_feed_is_doubled>("opt1_feed", "tenths|count_x_0.2",
                                     "unit of F with units = \"opt1\": 0.1 or 0.2 in/min"),
    row<&C::has_arcs>("circular", kFlag, "fitted: arcs"),
    row<&C::has_cycles>("fixed_cycles", kFlag, "fitted: fixed cycles, G81 to G89"),
    Row{{"cycle_table", "table",
         "steps of a cycle: { 81 = [\"feed_in\", \"rapid_out\"] }; steps are feed_in, peck_in, "
         "dwell, spindle_stop, spindle_reverse, program_stop, feed_out, rapid_out, manual_out",
         "as EIA RS-326-A"},
        read_cycle_table},
    row<&C::has_dwell>("dwell", kFlag, "fitted: dwell, G04"),
    row<&C::has_quill>("quill", kFlag, "fitted: quill in the place of a Z axis"),
    row<&C::has_spindle_speed>("spindle_s", kFlag, "fitted: spindle speed, S"),
    Row{{"spindle_table", "table", "speed of an S code: { 01 = 500 }", "", {}, "rpm"},
        read_spindle_table},
    row<&C::has_tool_codes>("tool_t", kFlag, "fitted: tool codes, T"),
    row<&C::has_tool_changer>("auto_toolchange", kFlag,
                              "fitted: tool changer; without one M06 stops the tape"),
    row<&C::has_mist>("mist", kFlag, "fitted: mist coolant, M07"),
    Row{{"mirror", kText, "axes with a mirror switch on the panel", "XYZ"}},
    row<&C::reader_characters_per_second>(
        "reader_cps", kNumber, "characters that the tape reader reads", kPositive, "1/s"),
    row<&C::checks_reader>("reader_check", kFlag,
                           "warns of blocks that take longer to read than to cut"),
    row<&C::max_feed>("max_feed", kNumber, "highest feed", kPositive, "in or mm/min",
                      "200; 400 with opt1; 2000 with opt2, metric"),
    row<&C::min_feed>("min_feed", kNumber, "lowest feed", kPositive, "in or mm/min",
                      "0.1; 0.2 with opt1; 1 with opt2, metric"),
    row<&C::rapid>("rapid", kNumber, "rapid traverse rate", kPositive, "in or mm/min",
                   "400; 2000 with opt2; 4000 with metric"),
    Row{{"travel_low", kAxisTable, "lower end of travel, machine coordinates", "no limit"},
        read_travel<&AxisLimits::low>},
    Row{{"travel_high", kAxisTable, "upper end of travel, machine coordinates", "no limit"},
        read_travel<&AxisLimits::high>},
    Row{{"usermcodes", "table", "names of the machine builder's M functions: { 23 = \"clamp\" }"},
        read_m_names},
    row<&C::runs_bad_arcs>("arc_policy", "alarm|run",
                           "what an arc off its circle or quadrant does"),
    Row{option("arc_tolerance", kWhole,
               "allowed distance of an arc's end from its circle, up to 1000", "5", {}, "count"),
        read_arc_tolerance},
    row<&C::skips_bad_blocks>("errors", "stop|skip_block",
                              "what happens at a block that cannot be read"),
    row<&C::is_strict>("strict", kFlag, "what the manual forbids stops the tape; else a warning"),
    row<&C::cycle_z_moves_with_xy>("cycle_z_with_xy", kFlag,
                                   "Z goes to R of a cycle together with X and Y"),
    row<&C::m05_is_delayed>("m05_delayed", kFlag, "M05 acts after the move of its block"),
    row<&C::m09_is_delayed>("m09_delayed", kFlag, "M09 acts after the move of its block"),
    row<&C::m05_stops_coolant>("m05_stops_coolant", kFlag, "M05 stops the coolant too"),
    Row{option("dwell_timer", kWhole, "position of the panel's dwell timer: 1.3 to 12 seconds", "1",
               {1, 15}),
        read_timer<&C::dwell_seconds>},
    Row{option("peck_timer", kWhole, "position of the panel's peck timer: 1.3 to 12 seconds", "1",
               {1, 15}),
        read_timer<&C::peck_seconds>},
    Row{{"mdi", "list of texts", "blocks keyed in before the tape starts"}, read_mdi},
    Row{{"search", kWhole, "sequence number to run the tape forward to, up to 999; -1: none", "-1"},
        read_search},
    Row{{"start_at", kText, "the same, as a start names it: N40; the operator is asked there"},
        read_start_at},
    row<&C::part>("part", kWhole,
                  "program of the tape that the start reads; after the last one the tape begins "
                  "again",
                  {1, 9999}),
    Row{{"zero", kAxisTable, "machine coordinates of the program's zero", "0 on every axis"},
        read_zero},
};

Result<void> read_mirror_switches(const Setup& setup, ControlOptions& control) {
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

std::vector<ListedOption> list_options() {
  return list_rows(kRows);
}

Result<ControlOptions> read_options(const Setup& setup) {
  ControlOptions control;
  if (auto done = read_rows(kRows, setup.control, control); !done) return fail(done.error());
  if (auto done = read_mirror_switches(setup, control); !done) return fail(done.error());
  control.optional_stop = setup.switches.optional_stop;
  control.is_mdi = setup.is_mdi;
  if (setup.is_mdi) control.mdi.clear();
  for (std::size_t i = 0; i < kAxes; ++i) {
    const Position& at = control.stops_at_search && setup.position ? *setup.position : setup.start;
    control.start[i] = counts(control, at.linear(static_cast<Axis>(i)));
  }
  return control;
}

}  // namespace dripline::interpreter::tektronix1704
