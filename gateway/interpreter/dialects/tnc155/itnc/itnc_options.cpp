#include <algorithm>
#include <charconv>
#include "gateway/interpreter/core/option_rows.hpp"

#include "gateway/interpreter/dialects/tnc155/options.hpp"
#include "gateway/interpreter/stages/tilting/kinematic_options.hpp"

namespace dripline::interpreter::tnc155 {
namespace itnc {
namespace {

using C = ControlOptions;
using Row = OptionRow<C>;

constexpr int kHighestBlock = 99'999'999;
constexpr OptionRange kSpeeds{0, 100'000};

Result<void> read_start(const Options& options, const OptionKey& /*key*/, C& control) {
  return read_start_block(options, kHighestBlock, control);
}

Result<void> read_tool_axis(const Options& options, const OptionKey& key, C& control) {
  const auto word = read_word(options, key, 0);
  if (!word) return fail(word.error());
  if (*word != 0) control.kept_tool_axis = axis_of(key.words()[*word].front());
  return {};
}

constexpr auto kOwnRows = std::array{
    row<&C::start_block>("start_block", kWhole,
                         "start in the middle: number of the first block; -1: none",
                         {-1, kHighestBlock}),
    Row{{"start_at", kText, "the same, as a start names it: N400 or 400"}, read_start},
    Row{kStartPass, read_start_pass},
    row<&C::cancels_transformations>("cancel_transformations", kFlag,
                                     "M2, M30 and END PGM cancel transformations"),
    row<&C::scales_three_axes>("scale_three_axes", kFlag,
                               "cycle 11 scales all main axes; else those of the plane"),
    row<&C::pocket_overlap>("pocket_overlap", kNumber,
                            "stepover of cycles 4 and 5 as a share of the tool radius", kPositive),
    row<&C::plunge_angle>("plunge_angle", kNumber,
                          "ANGLE of the tool table: how steeply cycles 251 to 254 plunge along a "
                          "helix or to and fro; 0: not at all, 90: straight down",
                          {0, 90}, "degrees"),
    row<&C::m89_modal>("m89_modal", kFlag,
                       "M89 calls the cycle after each positioning block; else a free M function"),
    row<&C::compares_rounded>(
        "comparison", "exact|rounded",
        "FN 9 to FN 12: all binary digits count, or values that differ by rounding are equal"),
    Row{{"tool_axis", "unknown|X|Y|Z",
         "of M140 before the first TOOL CALL, as the control keeps it from the run before",
         "unknown"},
        read_tool_axis},
    row<&C::m06_stop>("m06_stop", kFlag, "M6 stops the program"),
    row<&C::spindle_minimum>("spindle_minimum", kNumber, "lowest speed", kSpeeds, "rpm"),
    row<&C::spindle_maximum>("spindle_maximum", kNumber, "highest speed", kSpeeds, "rpm"),
    row<&C::contour_feed>(
        "rotary_feed", "rotary|contour",
        "feed of a move with linear and rotary axes: of the rotary axis, or along the path"),
    row<&C::circle_tolerance>("circle_tolerance", kLength,
                              "between the radii at start and end of an arc", kNotNegative),
    row<&C::limit_low>("limit_low", kAxisTable, "software limits, machine coordinates"),
    row<&C::limit_high>("limit_high", kAxisTable, "software limits, machine coordinates"),
    row<&C::m92_position>("m92_position", kAxisTable, "what coordinates of M92 refer to"),
};

constexpr auto kRows = [] {
  constexpr auto kKinematicRows = tilting::kinematic_rows<C>();
  std::array<Row, kOwnRows.size() + kKinematicRows.size()> rows{};
  std::ranges::copy(kOwnRows, rows.begin());
  std::ranges::copy(kKinematicRows, rows.begin() + kOwnRows.size());
  return in_table("option", rows);
}();

}  // namespace
}  // namespace itnc

std::vector<ListedOption> list_itnc_options() {
  return list_rows(itnc::kRows);
}

Result<ControlOptions> read_itnc_options(const Setup& setup) {
  ControlOptions read;
  read.is_itnc = true;
  read.program_start = ProgramStart::Any;
  read.checks_calls = false;
  read.decimal_sign = '.';
  read.block_skip = setup.switches.block_skip;
  if (auto done = read_rows(itnc::kRows, setup.control, read); !done) return fail(done.error());
  if (auto good = check_limits(read); !good) return fail(good.error());
  for (const OffsetRecord& offset : setup.offsets) {
    constexpr std::string_view kPreset = "preset";
    if (!offset.name.starts_with(kPreset)) continue;
    int number = 0;
    const char* const end = offset.name.data() + offset.name.size();
    const auto done = std::from_chars(offset.name.data() + kPreset.size(), end, number);
    if (done.ec != std::errc{} || done.ptr != end || number < 0) {
      return fail(Errc::Unsupported, "offset {}: this control has datum and preset0, preset1 ...",
                  offset.name);
    }
    read.presets.push_back({number, offset.value});
  }
  return read;
}

}  // namespace dripline::interpreter::tnc155
