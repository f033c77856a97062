#include "gateway/interpreter/dialects/fanuc/options.hpp"

#include <algorithm>

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/stages/tilting/kinematic_options.hpp"
#include "protocol/base/names.hpp"

namespace dripline::interpreter::fanuc {
namespace {

using Control = ControlOptions;
using Row = OptionRow<Control>;

/// What a model decides where no option does.
struct ModelRow {
  RepeatAddress repeat;
  CallForm call;
  std::size_t call_depth;
  int last_common, last_kept;
  bool has_pages = true;
  bool has_later_functions = false;
  bool has_long_variables = false;
  int program_digits = 4;
  std::uint32_t last_sequence = 99'999;
  bool has_program_names = false;
  std::size_t max_pockets = 10;
  bool has_rigid_tap_codes = false;
  bool compensates_in_contour = true;
};
constexpr ModelRow kSixteenI{RepeatAddress::K, CallForm::EightDigits, 4, 149, 531, true, true};
constexpr std::array<ModelRow, 9> kModels{
    {{RepeatAddress::Both, CallForm::EightDigits, 4, 149, 531, false, false, false, 4, 9999},
     {RepeatAddress::L, CallForm::L, 2, 149, 531, false, false, false, 4, 9999},
     {RepeatAddress::L, CallForm::L, 4, 199, 599, true, false, false, 4, 99'999, false, 10, true},
     {RepeatAddress::K, CallForm::EightDigits, 4, 149, 531},
     {RepeatAddress::K, CallForm::EightDigits, 10, 199, 999, true, true, false, 4, 99'999, false,
      0},
     kSixteenI,
     kSixteenI,
     kSixteenI,
     {RepeatAddress::K, CallForm::EightDigits, 10, 199, 999, true, true, true, 4, 99'999'999, true,
      0, false, false}}};

AxisValues values_of(const Position& position) {
  AxisValues values{};
  for (const Axis axis : kAllAxes) values[static_cast<std::size_t>(axis)] = position.raw(axis);
  return values;
}

Result<void> read_model(const Options& options, const OptionKey& key, Control& control) {
  if (options.find(key.key) == nullptr) return {};
  const auto model = read_word(options, key, 3);
  if (!model) return fail(model.error());
  const ModelRow& row = kModels[*model];
  control.model = static_cast<Model>(*model);
  control.repeat_address = row.repeat;
  control.call_form = row.call;
  control.max_call_depth = row.call_depth;
  control.last_common = row.last_common;
  control.last_kept = row.last_kept;
  control.has_pages = row.has_pages;
  control.has_later_functions = row.has_later_functions;
  control.has_long_variables = row.has_long_variables;
  control.program_digits = row.program_digits;
  control.last_sequence = row.last_sequence;
  control.has_program_names = row.has_program_names;
  control.max_pockets = row.max_pockets;
  control.has_rigid_tap_codes = row.has_rigid_tap_codes;
  control.compensates_in_contour = row.compensates_in_contour;
  if (row.call_depth > 8) control.max_nesting = 15;
  return {};
}

Result<void> read_program_digits(const Options& options, const OptionKey& key, Control& control) {
  if (auto done = read_value(options, key, control.program_digits); !done) return done;
  if (control.program_digits == 4 || control.program_digits == 8) return {};
  return fail(Errc::Syntax, "[control] program_digits: {} is neither 4 nor 8",
              control.program_digits);
}

Result<void> read_increment(const Options& options, const OptionKey& key, Control& control) {
  const auto increment = read_word(options, key, 1);
  if (!increment) return fail(increment.error());
  control.decimals_mm = 2 + static_cast<int>(*increment);
  return {};
}

/// Whether power on can put a code in force: a state that needs more than its code (a center, a
/// number) cannot be had.
bool is_start_code(std::int64_t code) {
  if (code < 0 || code >= 100) return false;
  const std::uint8_t group = group_of(static_cast<std::uint8_t>(code));
  constexpr std::array<std::int64_t, 5> kNeedMore{41, 42, 51, 66, 68};
  return group != kNoGroup && group != kOneShot && (group != kCycleGroup || code == 80) &&
         std::find(kNeedMore.begin(), kNeedMore.end(), code) == kNeedMore.end();
}

Result<void> read_start_codes(const Options& options, const OptionKey& key, Control& control) {
  std::vector<std::int64_t> codes{0, 17, 90, 94, 40, 49, 50, 54, 64, 67, 69, 80, 97, 98, 22, 15};
  if (control.is_lathe) codes.insert(codes.end(), {18, 95});
  const auto given = options.integers(key.key);
  if (!given) return fail(given.error());
  const auto& table = kCodeTables[static_cast<std::size_t>(control.code_system)];
  for (const std::int64_t code : *given) {
    const bool is_translated = control.is_lathe && code >= 0 && code < 100;
    codes.push_back(is_translated ? table[static_cast<std::size_t>(code)] : code);
  }
  for (const std::int64_t code : codes) {
    if (!is_start_code(code)) {
      return fail(Errc::Syntax, "[control] start_g: G{} is not a state this control can start in",
                  code);
    }
    if (code == 20) control.start_units = Units::Inch;
    if (code == 21) control.start_units = Units::Millimeter;
    control.start_g.push_back(static_cast<std::uint8_t>(code));
  }
  if (control.start_units == Units::Inch) {
    control.peck_return = Length::inch(0.004).mm();
    control.peck_clearance = Length::inch(0.04).mm();
    control.peck_tap_return = control.peck_return;
  }
  return {};
}

Result<void> read_reference(const Options& options, const OptionKey& key, Control& control) {
  const auto points = options.positions(key.key);
  if (!points) return fail(points.error());
  if (points->size() > control.reference.size()) {
    return fail(Errc::Syntax, "[control] reference: {} points, this control has {}", points->size(),
                control.reference.size());
  }
  std::transform(points->begin(), points->end(), control.reference.begin(), values_of);
  return {};
}

Result<void> read_shift_direction(const Options& options, const OptionKey& key, Control& control) {
  const auto direction = read_word(options, key, 0);
  if (!direction) return fail(direction.error());
  control.shift_first = *direction == 0 ? 1 : *direction == 1 ? -1 : 0;
  control.shift_second = *direction == 2 ? 1 : *direction == 3 ? -1 : 0;
  return {};
}

Result<void> read_single_direction(const Options& options, const OptionKey& key, Control& control) {
  const auto overrun = options.position(key.key);
  if (!overrun) return fail(overrun.error());
  control.single_direction = values_of(*overrun);
  return {};
}

Result<void> read_length_axis(const Options& options, const OptionKey& key, Control& control) {
  const auto type = read_word(options, key, 0);
  if (!type) return fail(type.error());
  control.length_axis_type = static_cast<char>('A' + *type);
  return {};
}

/// X, Y and Z of a corner; an axis that is left out is at `missing`.
std::array<double, 3> corner_of(const Position& position, double missing) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto axis = static_cast<Axis>(i);
    values[i] = position.has(axis) ? position.raw(axis) : missing;
  }
  return values;
}

/// Two corners are limit 1, two more the forbidden zone of limit 2.
Result<void> read_limits(const Options& options, const OptionKey& key, Control& control) {
  constexpr double kFar = 1e9;
  const auto corners = options.positions(key.key);
  if (!corners) return fail(corners.error());
  if (corners->size() % 2 != 0 || corners->size() > 4) {
    return fail(Errc::Syntax,
                "[control] stroke_limits: expected the lowest and the highest position of limit 1, "
                "and of limit 2");
  }
  control.has_limits = !corners->empty();
  if (control.has_limits) {
    control.limit_low = corner_of((*corners)[0], -kFar);
    control.limit_high = corner_of((*corners)[1], kFar);
  }
  if (corners->size() == 4) {
    control.zone.low = corner_of((*corners)[2], -kFar);
    control.zone.high = corner_of((*corners)[3], kFar);
  }
  return {};
}

Result<void> read_g_macros(const Options& options, const OptionKey& key, Control& control) {
  if (auto done = assign(read_integers(options, key), control.g_macros); !done) return done;
  for (const std::int64_t code : control.g_macros) {
    if (code >= 65 && code <= 67) {
      return fail(Errc::Syntax, "[control] g_macro: G{} cannot call a program", code);
    }
  }
  return {};
}

Result<void> read_external_folder(const Options& options, const OptionKey& key, Control& control) {
  if (auto done = assign(options.text(key.key, ""), control.external_folder); !done) return done;
  if (control.external_folder.empty()) return {};
  constexpr std::size_t kLongestName = 32;  // of a called program
  const auto good = check_program_name(control.external_folder + std::string(kLongestName, 'O'));
  if (good) return {};
  return fail(Errc::Syntax, "[control] m198_folder: {}", good.error().what);
}

Result<void> read_skip_levels(const Options& options, const OptionKey& key, Control& control) {
  const auto levels = read_integers(options, key);
  if (!levels) return fail(levels.error());
  for (const std::int64_t level : *levels) {
    control.skip_levels = static_cast<std::uint16_t>(control.skip_levels | (1u << level));
  }
  return {};
}

// A row that others depend on is above them: model, start_g.
constexpr std::array kSharedRows{
    Row{{"model", "0M|6M|11M|16M|0i|16i|18i|21i|30i",
         "sets the defaults of repeat_address, m98_form, max_call_depth, last_common, last_kept, "
         "program_digits, program_names, rigid_tap_codes; whether the control has G54.1, MOD and "
         "POW, and the long numbers of system variables, names of variables and PRM; of a lathe, "
         "how many pockets G71 and G72 cut, and whether G41 and G42 may be within a contour",
         "16M"},
        read_model},
    row<&Control::calculator_point>(
        "calculator_point", kFlag,
        "a number without a point is in millimeters or inches, not increments"),
    Row{{"increment", "IS-A|IS-B|IS-C", "least increment: 0.01, 0.001, 0.0001 mm", "IS-B"},
        read_increment},
    row<&Control::start_units>("start_units", "in|mm", "units in force at power on"),
    Row{{"start_g", kWholes, "G codes in force at power on besides the usual ones"},
        read_start_codes},
    row<&Control::call_form>("m98_form", "P8|L|both",
                             "repeats of M98: in P of up to 8 digits, or in a word L"),
    row<&Control::start_up_b>("startup", "A|B", "start and cancel of cutter compensation"),
    Row{{"reference", kAxisTables, "first to fourth reference point, in machine coordinates",
         "0 on every axis"},
        read_reference},
    row<&Control::arc_error>(
        "arc_error", kLength,
        "allowed difference of the radii at start and end of an arc; 0: not checked"),
    row<&Control::arc_needs_center>("arc_without_center", "line|alarm",
                                    "what an arc without I, J, K and R is"),
    row<&Control::short_radius_is_semicircle>("short_radius", "alarm|semicircle",
                                              "what R is that is too short to reach the end"),
    row<&Control::helix_feed_is_path>(
        "helix_feed", "circle|path",
        "F of a helix is the speed along its circle, or along its path"),
    row<&Control::leading_zero_print>("leading_zero_print", kFlag,
                                      "DPRNT prints blanks for leading zeros"),
    Row{{"print_newline", "LF|CRLF|LFCRCR",
         "end of a line of DPRNT at a real control; no effect here"},
        check_option<Control>},
    row<&Control::print_expands>("print_overflow", "cut|expand",
                                 "a number too long for its DPRNT format is cut, or printed"),
    row<&Control::atan_is_signed>("atan_range", kWhole,
                                  "results of ATAN: 0: 0 to 360 degrees; 1: -180 to 180", {0, 1}),
    row<&Control::reset_clears_locals>("reset_clears_locals", kFlag,
                                       "reset and M30 clear #1 to #33"),
    row<&Control::reset_clears_commons>("reset_clears_commons", kFlag,
                                        "reset and M30 clear the variables from #100"),
    Row{{"stroke_limits", kAxisTables,
         "lowest and highest position of limit 1, then of the forbidden zone of limit 2"},
        read_limits},
    Row{option("skip_levels", kWholes, "block skip switches that are on: /2 to /9, and / or /1", "",
               {1, 9}),
        read_skip_levels},
    row<&Control::m_macros>("m_macro", kWholes, "M codes that call O9020 to O9029 as a macro",
                            {1, 99'999'999, false, 10}),
    Row{option("g_macro", kWholes, "G codes that call O9010 to O9019 as a macro", "",
               {1, 255, false, 10}),
        read_g_macros},
    row<&Control::t_macro>("t_macro", kFlag, "T calls O9000"),
    row<&Control::semicolon_eob>("semicolon_eob", kFlag, "a semicolon ends a block"),
    row<&Control::comment_over_eob>("comment_over_eob", kFlag,
                                    "a comment may go over ends of blocks"),
    row<&Control::feed_unit_inch>("feed_unit_inch", kNumber, "unit of F without a point in inch",
                                  kPositive, "inch/min"),
    row<&Control::dry_run_feed>("dry_run_feed", kFeed,
                                "feed of a dry run at a gateway; 0: its panel has no dry run",
                                kNotNegative),
    row<&Control::before_m>("before_m", kWholes,
                            "M codes that act before the move of their block; none: all do"),
    row<&Control::is_dnc>(
        "dnc", kFlag,
        "as in a DNC run: no loops and jumps in the fed program; calls take programs "
        "of the library"),
    Row{{"m198_folder", kText,
         "what precedes the name of a program that M198 calls: with \"CARD.\" M198 P2000 takes "
         "CARD.O2000 of the library",
         "none: M198 calls as M98 does"},
        read_external_folder},
    Row{{"unroll", kFlag,
         "sends a real control the program without loops and calls; no effect here", "false"},
        check_option<Control>},
    row<&Control::max_call_depth>("max_call_depth", kWhole, "calls within calls", {1, 16}),
    row<&Control::max_nesting>("max_nesting", kWhole,
                               "calls within calls, macros and subprograms together",
                               {1, kMaxFrames}),
    row<&Control::max_loops>("max_loops", kWhole, "jumps back without a move before an alarm",
                             {1, 1e9}),
    row<&Control::max_blocks>("max_blocks", kWhole, "blocks without a move before an alarm",
                              {1, 1e12}),
    row<&Control::last_common>("last_common", kWhole, "last variable from #100", {149, 199}),
    row<&Control::last_kept>("last_kept", kWhole, "last variable from #500", {531, 999}),
    row<&Control::has_extra_commons>("extra_commons", kFlag,
                                     "the variables #98000 to #98499, which are kept"),
    Row{option("program_digits", kWhole, "digits of program numbers: 4 or 8", "4", {4, 8}),
        read_program_digits},
    row<&Control::has_program_names>("program_names", kFlag,
                                     "programs may have a name, <NAME>, instead of an O number"),
    pins_row<&Control::pins_at_one, &Control::answers_pins>()};

constexpr std::array kMillRows{
    row<&Control::has_tool_changer>(
        "tool_changer", kFlag,
        "false: M06 stops the spindle and waits until the operator has changed"),
    row<&Control::repeat_address>("repeat_address", "K|L|both",
                                  "address of the repeats of a canned cycle"),
    row<&Control::offset_memory>("offset_memory", "A|B|C",
                                 "tool offsets: one, geometry and wear, or these for H and D each"),
    row<&Control::peck_return>("g73_return", kLength, "retraction of a peck of G73", kNotNegative,
                               "", "0.1 mm, 0.004 in"),
    row<&Control::peck_clearance>("g83_clearance", kLength,
                                  "where G83 goes from rapid to feed, above the last depth",
                                  kNotNegative, "", "1 mm, 0.04 in"),
    row<&Control::has_rigid_tap_codes>(
        "rigid_tap_codes", kFlag,
        "the control has G84.2 and G84.3, rigid tapping without M29 (Series 15 format)"),
    row<&Control::peck_tap_leaves>("peck_tapping", "high-speed|standard",
                                   "a peck of rigid tapping goes back a little, or out to R"),
    row<&Control::peck_tap_return>("peck_tapping_return", kLength,
                                   "retraction of a peck of rigid tapping", kNotNegative, "",
                                   "0.1 mm, 0.004 in"),
    Row{{"shift_direction", "+X|-X|+Y|-Y", "direction of the shift of G76 and G87"},
        read_shift_direction},
    Row{{"single_direction", kAxisTable, "overrun of G60, with its sign", "0 on every axis"},
        read_single_direction},
    row<&Control::scale_default>("scale_default", kNumber, "factor of G51 without P"),
    row<&Control::rotate_default>("rotate_default", kNumber, "angle of G68 without R", {},
                                  "degree"),
    row<&Control::rotate_incremental>("rotate_incremental", kFlag,
                                      "R of G68 in G91 is added to the angle in force"),
    row<&Control::measuring_rapid_end>("g37_clearance", kLength,
                                       "G37 feeds from so far before the position; 0: no G37",
                                       kNotNegative),
    row<&Control::measuring_tolerance>(
        "g37_tolerance", kLength, "G37 expects the signal so close to the position", kNotNegative),
    row<&Control::measuring_feed>("g37_feed", kFeed, "feed of G37", kNotNegative),
    row<&Control::diameter_offset>("diameter_offset", kFlag,
                                   "offsets of cutter compensation are diameters"),
    Row{{"length_axis", "A|B|C", "type of tool length compensation"}, read_length_axis}};

constexpr std::array kLatheRows{
    row<&Control::code_system>("code_system", "A|B|C", "which set of G codes the lathe has"),
    row<&Control::x_is_diameter>("x_is_diameter", kFlag, "X and U are diameters", {}, "", "true"),
    row<&Control::has_c_axis>("c_axis", kFlag, "the lathe has an axis C; without it C is an alarm"),
    row<&Control::has_y_axis>("y_axis", kFlag, "the lathe has an axis Y; without it Y is an alarm"),
    row<&Control::turret_digits>("turret_digits", kWhole,
                                 "last digits of T that are the offset's number", {1, 2}),
    row<&Control::feed_unit_turn>("feed_unit_revolution", kNumber,
                                  "unit of F without a point in feed per revolution; 0: an alarm",
                                  kNotNegative, "", "0"),
    row<&Control::thread_chamfer>("thread_chamfer", kNumber,
                                  "pull-out of the thread cycle, in leads", kNotNegative),
};

template <std::size_t kFirst, std::size_t kSecond>
constexpr auto joined(const std::array<Row, kFirst>& first,
                      const std::array<Row, kSecond>& second) {
  std::array<Row, kFirst + kSecond> rows{};
  std::copy(second.begin(), second.end(), std::copy(first.begin(), first.end(), rows.begin()));
  return rows;
}
constexpr auto kMillOptions =
    joined(joined(kSharedRows, kMillRows), tilting::kinematic_rows<Control>());
/// code_system decides what start_g means.
constexpr auto kLatheOptions = joined(kLatheRows, kSharedRows);

}  // namespace

std::vector<ListedOption> list_options() {
  return list_rows(kMillOptions);
}
std::vector<ListedOption> list_lathe_options() {
  return list_rows(kLatheOptions);
}

Result<ControlOptions> read_options(const Setup& setup, bool is_lathe) {
  ControlOptions control;
  control.is_lathe = control.x_is_diameter = is_lathe;
  auto done = is_lathe ? read_rows(kLatheOptions, setup.control, control)
                       : read_rows(kMillOptions, setup.control, control);
  if (!done) return fail(done.error());
  if (!setup.switches.mirror.empty()) {
    return fail(Errc::Unsupported, "switches.mirror: this control mirrors with G51");
  }
  if (setup.switches.block_skip) control.skip_levels |= 1u << 1;
  control.optional_stop = setup.switches.optional_stop;
  control.is_mdi = setup.is_mdi;
  control.is_dnc |= setup.is_mdi;  // GOTO and WHILE are alarm 123 there too
  return control;
}

}  // namespace dripline::interpreter::fanuc
