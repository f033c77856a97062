#include "gateway/interpreter/dialects/tnc155/options.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>

#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// Reads options one after the other; the first error stays.
class Reader {
 public:
  struct Bounds {
    int least, most;
  };
  explicit Reader(const Options& options) : options_(options) {}

  void flag(std::string_view key, bool& value) { take(options_.flag(key, value), value); }
  void number(std::string_view key, double& value) { take(options_.number(key, value), value); }
  void length(std::string_view key, double& value) {
    Length read = Length::mm(value);
    take(options_.length(key, read), read);
    value = read.mm();
  }
  void integer(std::string_view key, int& value, Bounds bounds) {
    std::int64_t read = value;
    take(options_.integer(key, read), read);
    if (read < bounds.least || read > bounds.most) {
      refuse(fail(Errc::Syntax, "option {}: {} is not a number from {} to {}", key, read,
                  bounds.least, bounds.most));
      return;
    }
    value = static_cast<int>(read);
  }
  void position(std::string_view key, Position& value) { take(options_.position(key), value); }
  std::size_t choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                     std::size_t fallback) {
    take(options_.choice(key, allowed, fallback), fallback);
    return fallback;
  }
  void not_negative(std::string_view key, double value) {
    if (value < 0) refuse(fail(Errc::Syntax, "option {}: {} is less than 0", key, value));
  }
  void positive(std::string_view key, double value) {
    if (!(value > 0)) refuse(fail(Errc::Syntax, "option {}: {} is not more than 0", key, value));
  }
  void within(std::string_view key, double value, Bounds bounds) {
    if (value >= bounds.least && value <= bounds.most) return;
    refuse(
        fail(Errc::Syntax, "option {}: {} is not {} to {}", key, value, bounds.least, bounds.most));
  }
  void refuse(Result<void> error) {
    if (!error_ && !error) error_ = error.error();
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  template <class Value>
  void take(Result<Value> read, Value& value) {
    if (read) {
      value = std::move(*read);
    } else {
      refuse(fail(read.error()));
    }
  }
  const Options& options_;
  std::optional<Error> error_;
};

/// `start_at`, as a start names it: "N400" or "400". It goes before `start_block`.
Result<void> read_start(const Options& options, int& start_block) {
  const auto text = options.text("start_at", "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  const std::string_view digits = std::string_view(*text).substr(text->front() == 'N' ? 1 : 0);
  int number = -1;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() || number < 0 ||
      number > kMaxBlockNumber) {
    return fail(Errc::Syntax,
                "option start_at: \"{}\" is no block of this control: it goes to N0 to N{}", *text,
                kMaxBlockNumber);
  }
  start_block = number;
  return {};
}

constexpr int kFastestSpindle = 30'000;

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

Result<std::vector<double>> read_speeds(const Options& options) {
  auto read = options.integers("spindle_table");
  if (!read) return fail(read.error());
  if (read->empty()) return preferred_speeds();
  std::vector<double> speeds;
  for (const std::int64_t speed : *read) {
    if (!speeds.empty() && static_cast<double>(speed) <= speeds.back()) {
      return fail(Errc::Syntax, "option spindle_table: {} does not rise above {}", speed,
                  speeds.back());
    }
    speeds.push_back(static_cast<double>(speed));
  }
  return speeds;
}

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

/// Values that exclude each other, or that no control has.
void check_limits(const ControlOptions& read, Reader& reader) {
  reader.not_negative("probe_clearance", read.probe_clearance);
  reader.not_negative("probe_travel", read.probe_travel);
  reader.not_negative("circle_tolerance", read.circle_tolerance);
  reader.positive("probe_feed", read.probe_feed);
  reader.positive("pocket_overlap", read.pocket_overlap);
  reader.within("basic_rotation", read.basic_rotation, {-360, 360});
  reader.within("spindle_minimum", read.spindle_minimum, {0, kFastestSpindle});
  reader.within("spindle_maximum", read.spindle_maximum, {0, kFastestSpindle});
  if (read.spindle_minimum > read.spindle_maximum) {
    reader.refuse(fail(Errc::Syntax, "option spindle_minimum: {} is more than spindle_maximum, {}",
                       read.spindle_minimum, read.spindle_maximum));
  }
  for (const Axis axis : kAllAxes) {
    if (!read.limit_low.has(axis) || !read.limit_high.has(axis)) continue;
    if (read.limit_low.raw(axis) <= read.limit_high.raw(axis)) continue;
    reader.refuse(fail(Errc::Syntax, "option limit_low: {} {} is above limit_high, {}",
                       letter(axis), read.limit_low.raw(axis), read.limit_high.raw(axis)));
  }
}

Result<void> check_names(const Options& options) {
  return options.check_known({"basic_rotation_touches",  // of dnc touch
                              "program_start",
                              "random_changer",
                              "magazine_pockets",
                              "probe_clearance",
                              "probe_travel",
                              "probe_feed",
                              "basic_rotation",
                              "pocket_overlap",
                              "m89_modal",
                              "m06_stop",
                              "central_tool_file",
                              "decimal_sign",
                              "iso_continuation",
                              "strict_numbers",
                              "blockwise_restrictions",
                              "heading_letter",
                              "cancel_transformations",
                              "scale_three_axes",
                              "spindle",
                              "spindle_table",
                              "spindle_minimum",
                              "spindle_maximum",
                              "rotary_feed",
                              "circle_tolerance",
                              "fourth_axis",
                              "limit_low",
                              "limit_high",
                              "m92_position",
                              "start_block",
                              "memory_limits",
                              "memory_blocks",
                              "machine_parameters",
                              "start_at",
                              "program_check",
                              "iso_modes",
                              "model",
                              "software",
                              "display_units",
                              "position_display",
                              "display_size",
                              "block_increment",
                              "baud_rate",
                              "nc_software",
                              "plc_software",
                              "user_parameters"});
}

}  // namespace

Result<char> decimal_sign_of(const Options& options) {
  const auto choice = options.choice("decimal_sign", {"comma", "point"}, 0);
  if (!choice) return fail(choice.error());
  return *choice == 0 ? ',' : '.';
}

Result<ControlOptions> read_options(const Setup& setup) {
  const Options& options = setup.control;
  auto known = check_names(options);
  if (!known) return fail(known.error());
  ControlOptions read;
  Reader reader(options);
  reader.length("probe_clearance", read.probe_clearance);
  reader.length("probe_travel", read.probe_travel);
  reader.length("probe_feed", read.probe_feed);
  reader.number("basic_rotation", read.basic_rotation);
  reader.number("pocket_overlap", read.pocket_overlap);
  reader.flag("m89_modal", read.m89_modal);
  reader.flag("m06_stop", read.m06_stop);
  reader.flag("central_tool_file", read.central_tool_file);
  reader.flag("random_changer", read.random_changer);
  reader.integer("magazine_pockets", read.magazine_pockets, {0, 9'999});
  reader.flag("iso_continuation", read.iso_continuation);
  reader.flag("blockwise_restrictions", read.blockwise_restrictions);
  reader.flag("cancel_transformations", read.cancels_transformations);
  reader.flag("scale_three_axes", read.scales_three_axes);
  reader.choice("heading_letter", {"%", "H"}, 0);  // of dncgw --line, dnc port
  reader.flag("strict_numbers", read.strict_numbers);
  const auto sign = decimal_sign_of(options);
  if (!sign) return fail(sign.error());
  read.decimal_sign = *sign;
  read.modes_go_over_calls = reader.choice("iso_modes", {"program", "run"}, 0) == 1;
  read.checks_calls = reader.choice("program_check", {"start", "call"}, 0) == 0;
  read.program_start =
      static_cast<ProgramStart>(reader.choice("program_start", {"absolute", "complete", "any"}, 0));
  reader.flag("memory_limits", read.memory_limits);
  int memory_blocks = static_cast<int>(read.memory_blocks);
  reader.integer("memory_blocks", memory_blocks, {1, 100'000});
  read.memory_blocks = static_cast<std::size_t>(memory_blocks);
  read.spindle_coded = reader.choice("spindle", {"analogue", "coded"}, 0) == 1;
  reader.number("spindle_minimum", read.spindle_minimum);
  reader.number("spindle_maximum", read.spindle_maximum);
  read.contour_feed = reader.choice("rotary_feed", {"contour", "rotary"}, 0) == 0;
  reader.length("circle_tolerance", read.circle_tolerance);
  constexpr std::string_view kFourth = "ABCUVW";
  const std::size_t fourth = reader.choice("fourth_axis", {"A", "B", "C", "U", "V", "W"}, 2);
  read.fourth_axis = *axis_of(kFourth[fourth]);
  reader.position("limit_low", read.limit_low);
  reader.position("limit_high", read.limit_high);
  reader.position("m92_position", read.m92_position);
  reader.integer("start_block", read.start_block, {-1, 65'534});
  check_limits(read, reader);
  if (reader.error()) return fail(*reader.error());
  if (auto start = read_start(options, read.start_block); !start) return fail(start.error());
  if (auto kept = machine_parameters_of(options); !kept) return fail(kept.error());
  const auto version = version_of(options);
  if (!version) return fail(version.error());
  read.version = *version;
  if (auto fits = check_version(options, read); !fits) return fail(fits.error());
  const auto mod = read_mod_settings(options);
  if (!mod) return fail(mod.error());
  read.block_increment = mod->block_increment;
  auto speeds = read_speeds(options);
  if (!speeds) return fail(speeds.error());
  read.spindle_table = std::move(*speeds);
  return read;
}

}  // namespace dripline::interpreter::tnc155
