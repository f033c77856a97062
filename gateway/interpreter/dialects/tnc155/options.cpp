#include "gateway/interpreter/dialects/tnc155/options.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

using C = ControlOptions;
using Row = OptionRow<C>;

constexpr double kFastestSpindle = 30'000;
constexpr OptionRange kSpindleSpeeds{0, kFastestSpindle};

/// The preferred numbers of coded speeds: a twentieth of a decade apart, five decades.
std::vector<double> preferred_speeds() {
  constexpr double kDecade[] = {1,    1.12, 1.25, 1.4, 1.6, 1.8, 2,   2.24, 2.5, 2.8,
                                3.15, 3.55, 4,    4.5, 5,   5.6, 6.3, 7.1,  8,   9};
  std::vector<double> speeds;
  for (const double factor : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
    for (const double mantissa : kDecade) speeds.push_back(mantissa * factor);
  }
  return speeds;
}

Result<void> read_speeds(const Options& options, const OptionKey& key, C& control) {
  const auto speeds = options.integers(key.key);
  if (!speeds) return fail(speeds.error());
  if (speeds->empty()) control.spindle_table = preferred_speeds();
  for (const std::int64_t number : *speeds) {
    const auto speed = static_cast<double>(number);
    if (!control.spindle_table.empty() && speed <= control.spindle_table.back()) {
      return fail(Errc::Syntax, "option spindle_table: {} does not rise above {}", number,
                  control.spindle_table.back());
    }
    control.spindle_table.push_back(speed);
  }
  return {};
}

Result<void> read_decimal_sign(const Options& options, const OptionKey&, C& control) {
  return assign(decimal_sign_of(options), control.decimal_sign);
}

Result<void> read_fourth_axis(const Options& options, const OptionKey& key, C& control) {
  const auto axis = read_word(options, key, 2);
  if (!axis) return fail(axis.error());
  control.fourth_axis = *axis_of(key.words()[*axis].front());
  return {};
}

/// It goes before `start_block`, which is above this row.
Result<void> read_start_at(const Options& options, const OptionKey& /*key*/, C& control) {
  return read_start_block(options, kMaxBlockNumber, control);
}

constexpr auto kOptionRows = in_table(
    "option",
    std::array{
        // Which control it is
        Row{{"model", kText,
             "TNC 155 or TNC 151 with A, P, AR, PR, E, V, ER or VR: decides which functions exist",
             "TNC 155 A"}},
        Row{option("software", kWhole,
                   "last two digits of the NC software's number: decides which functions exist",
                   "nc_software's, or 8", {1, ControlVersion::kHighestSoftware})},
        Row{{"nc_software", kText, "number of the NC software, as 227 020 08"}},
        Row{{"plc_software", kText, "number of the PLC software, as 228 601 01"}},
        // Memory
        row<&C::memory_limits>(
            "memory_limits", kFlag,
            "true: a program that does not fit the memory is an alarm; else a warning"),
        row<&C::memory_blocks>("memory_blocks", kWhole, "blocks of all programs in the memory",
                               {1, 100'000}),
        row<&C::strict_numbers>("strict_numbers", kFlag,
                                "a gap in the block numbers of plain language is an alarm"),
        row<&C::checks_calls>("program_check", "call|start",
                              "when called programs must be there: at the call, the start"),
        row<&C::program_start>(
            "program_start", "absolute|complete|any",
            "what the first positioning block must be; complete: with two coordinates"),
        row<&C::blockwise_restrictions>(
            "blockwise_restrictions", kFlag,
            "refuses calls, repeats, jumps and all tools but the one defined last"),
        row<&C::start_block>("start_block", kWhole,
                             "GOTO before the start: number of the first block; -1: none",
                             {-1, kMaxBlockNumber}),
        Row{{"start_at", kText, "the same, as a start names it: N400 or 400"}, read_start_at},
        Row{kStartPass, read_start_pass},
        // Program text
        Row{{"decimal_sign", "comma|point", "in programs that are written"}, read_decimal_sign},
        Row{{"heading_letter", "%|H",
             "in headings of blockwise transfers where dncgw --line is the control"},
            check_option<C>},
        row<&C::iso_continuation>("iso_continuation", kFlag,
                                  "an ISO line without a number continues the block before it"),
        row<&C::modes_go_over_calls>(
            "iso_modes", "program|run",
            "what is in force in ISO belongs to each program, or to the run"),
        Row{option("block_increment", kWhole,
                   "of ISO block numbers that are written; 0: blocks get none", "10", {0, 99})},
        // Tools
        row<&C::central_tool_file>(
            "central_tool_file", kFlag,
            "true: [[tool]] is the tool store; else for tools without TOOL DEF"),
        row<&C::random_changer>("random_changer", kFlag,
                                "a tool goes back into the pocket of the next one"),
        row<&C::magazine_pockets>("magazine_pockets", kWhole, "pockets of the random changer",
                                  {0, 9'999}),
        // Touch probe
        row<&C::probe_clearance>("probe_clearance", kLength,
                                 "distance in front of the expected point", kNotNegative),
        row<&C::probe_travel>("probe_travel", kLength,
                              "longest travel without contact before an alarm", kNotNegative),
        row<&C::probe_feed>("probe_feed", kFeed, "feed of probing", kPositive, "", "200 mm/min"),
        row<&C::basic_rotation>("basic_rotation", kNumber,
                                "angle of the workpiece, as dnc touch measures it", {-360, 360},
                                "degree"),
        Row{{"basic_rotation_touches", "list of texts",
             "the two points it was measured with, for dnc touch corner --rotation-touches"}},
        // Cycles and auxiliary functions
        row<&C::pocket_overlap>("pocket_overlap", kNumber,
                                "stepover of pockets as a share of the tool radius", kPositive),
        row<&C::cancels_transformations>("cancel_transformations", kFlag,
                                         "M02, M30 and END PGM cancel transformations (MP 173)"),
        row<&C::scales_three_axes>("scale_three_axes", kFlag,
                                   "cycle 11 scales all main axes; else those of the plane"),
        row<&C::m89_modal>("m89_modal", kFlag, "M89 calls the cycle at every block"),
        row<&C::m06_stop>("m06_stop", kFlag, "M06 stops the program"),
        // Spindle and feed
        row<&C::spindle_coded>("spindle", "analog|coded",
                               "coded: speeds of spindle_table only, rounded up"),
        Row{option("spindle_table", kWholes, "coded speeds, rising",
                   "20 preferred numbers a decade", {}, "rpm"),
            read_speeds},
        row<&C::spindle_minimum>("spindle_minimum", kNumber, "lowest speed", kSpindleSpeeds, "rpm"),
        row<&C::spindle_maximum>("spindle_maximum", kNumber, "highest speed", kSpindleSpeeds,
                                 "rpm"),
        row<&C::contour_feed>(
            "rotary_feed", "rotary|contour",
            "feed of a move with linear and rotary axes: of the rotary axis, or along the path"),
        // Axes
        Row{{"fourth_axis", "A|B|C|U|V|W", "what IV is", "C"}, read_fourth_axis},
        row<&C::circle_tolerance>("circle_tolerance", kLength,
                                  "between the radii at start and end of an arc", kNotNegative),
        row<&C::limit_low>("limit_low", kAxisTable, "MOD function LIMIT, machine coordinates"),
        row<&C::limit_high>("limit_high", kAxisTable, "MOD function LIMIT, machine coordinates"),
        row<&C::m92_position>("m92_position", kAxisTable, "what coordinates of M92 refer to"),
        // MOD functions, kept for the control
        Row{{"display_units", "mm|inch", "of the display only"}},
        Row{{"position_display", "ACTL|REF|LAG|NOML|DIST",
             "actual, from the reference point, following error, nominal, distance to go"}},
        Row{{"display_size", "small|large", "large: the current block only"}},
        Row{option("baud_rate", kWhole, "of the control's interface, for dnc port show", "",
                   {110, 9'600}, "baud")},
        Row{{"machine_parameters", "table", "kept for the control and sent to it: { MP71 = 515 }"}},
        Row{{"user_parameters", "list of tables",
             "machine parameters the operator may set: parameter, text, value, min, max"}},
    });

/// Options that turn on what the control's version has not.
Result<void> check_version(const Options& options, ControlOptions& read) {
  const ControlVersion& version = read.version;
  const auto refuse = [&](std::string_view option, Feature feature) {
    return fail(Errc::Unsupported, "option {}: {}", option, version.lacks(feature));
  };
  if (read.central_tool_file && !version.has(Feature::ToolStore)) {
    return refuse("central_tool_file", Feature::ToolStore);
  }
  if (read.blockwise_restrictions && !version.has(Feature::BlockwiseTransfer)) {
    return refuse("blockwise_restrictions", Feature::BlockwiseTransfer);
  }
  if (!version.has(Feature::SplitFeed)) {
    const bool is_named = options.find("rotary_feed") != nullptr;
    if (is_named && read.contour_feed) return refuse("rotary_feed", Feature::SplitFeed);
    read.contour_feed = false;
  }
  // A machine that names its model has the memory of that; one that names none may have any.
  if (options.find("model") == nullptr) return {};
  const auto memories = version.memories();
  if (std::ranges::find(memories, read.memory_blocks) != memories.end()) return {};
  return fail(Errc::Unsupported, "option memory_blocks: {}: a {} has {}", read.memory_blocks,
              version.model(), fmt::join(memories, " or "));
}

}  // namespace

Result<void> check_limits(const ControlOptions& read) {
  if (read.spindle_minimum > read.spindle_maximum) {
    return fail(Errc::Syntax, "option spindle_minimum: {} is more than spindle_maximum, {}",
                read.spindle_minimum, read.spindle_maximum);
  }
  for (const Axis axis : kAllAxes) {
    if (!read.limit_low.has(axis) || !read.limit_high.has(axis)) continue;
    if (read.limit_low.raw(axis) <= read.limit_high.raw(axis)) continue;
    return fail(Errc::Syntax, "option limit_low: {} {} is above limit_high, {}", letter(axis),
                read.limit_low.raw(axis), read.limit_high.raw(axis));
  }
  return {};
}

Result<void> read_start_block(const Options& options, int highest, ControlOptions& control) {
  const auto text = options.text("start_at", "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  const std::string_view digits = std::string_view(*text).substr(text->front() == 'N' ? 1 : 0);
  int number = -1;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() || number < 0 ||
      number > highest) {
    return fail(Errc::Syntax,
                "option start_at: \"{}\" is no block of this control: it goes to N0 to N{}", *text,
                highest);
  }
  control.start_block = number;
  return {};
}

Result<void> read_start_pass(const Options& options, const OptionKey& key,
                             ControlOptions& control) {
  if (auto read = read_value(options, key, control.start_pass); !read) return read;
  if (control.start_pass == 0 || control.start_block >= 0) return {};
  return fail(Errc::Syntax, "option start_pass: {} and no start_at or start_block",
              control.start_pass);
}

std::vector<ListedOption> list_options() {
  return list_rows(kOptionRows);
}

Result<char> decimal_sign_of(const Options& options) {
  const auto choice = options.choice("decimal_sign", {"comma", "point"}, 0);
  if (!choice) return fail(choice.error());
  return *choice == 0 ? ',' : '.';
}

Result<ControlOptions> read_options(const Setup& setup) {
  const Options& options = setup.control;
  ControlOptions read;
  if (auto done = read_rows(kOptionRows, options, read); !done) return fail(done.error());
  if (auto good = check_limits(read); !good) return fail(good.error());
  if (auto kept = machine_parameters_of(options); !kept) return fail(kept.error());
  const auto version = version_of(options);
  if (!version) return fail(version.error());
  read.version = *version;
  if (auto fits = check_version(options, read); !fits) return fail(fits.error());
  const auto mod = read_mod_settings(options);
  if (!mod) return fail(mod.error());
  read.block_increment = mod->block_increment;
  return read;
}

}  // namespace dripline::interpreter::tnc155
