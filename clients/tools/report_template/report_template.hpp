#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/report_template/line_form.hpp"
#include "protocol/measurement/measurement.hpp"

namespace dripline::report_template {

inline constexpr std::size_t kMaxTemplate = 256 * 1024;  ///< bytes of a file
inline constexpr std::size_t kMaxRules = 64;
inline constexpr std::size_t kMaxSteps = 8;  ///< lines of one rule
inline constexpr std::size_t kMaxCharacteristics = 1000;
inline constexpr std::size_t kMaxName = 128;  ///< of a characteristic, part, serial, tool

/// What a template states of a characteristic; what a line itself states has priority.
struct Definition {
  std::string name;  ///< replaces the one in the lines; empty: that one stays
  std::optional<double> nominal, lower, upper, tolerance, upper_deviation, lower_deviation;
  std::optional<measurement::ReworkSide> rework;
  std::string unit, tool;
  std::optional<std::uint8_t> decimals;
  bool is_required = false;  ///< a part without it is incomplete
};

/// One kind of line, or of lines that follow each other.
struct LineRule {
  std::vector<LineForm> steps;  ///< at least one
  bool starts_part = false;     ///< with this line; what was open before is over
  bool ends_part = false;
  bool is_ignored = false;     ///< known, and nothing is taken from it
  std::string characteristic;  ///< its name, with {field}s; empty: the field characteristic
  Definition definition;       ///< of what its lines report
  unsigned line = 0;           ///< of the file
};

/// What to do when a part has this verdict.
enum class Action : std::uint8_t { None, HoldQueue, HoldMachine };
std::string_view to_string(Action action);  ///< none, hold_queue, hold_machine

/// Which axes the line of a probe record has.
enum class ProbeAxes : std::uint8_t { All, Moved };

/// How lines of a report become measurements. Immutable; any thread.
struct ReportTemplate {
  std::string title;
  std::vector<std::string> sources{"output", "probe"};  ///< kinds of records
  std::string device;                                   ///< of the output; empty: any
  ProbeAxes probe_axes = ProbeAxes::All;
  Definition defaults;
  std::vector<LineRule> rules;
  std::map<std::string, Definition, std::less<>> characteristics;  ///< by their name in lines
  std::int64_t first_count = 1;           ///< of a counted report, in each part
  std::optional<std::uint64_t> expected;  ///< lines with values of a part
  Action on_rework = Action::None, on_scrap = Action::None, on_unknown = Action::None;
};

/// Errors: Syntax, Conflict, LimitExceeded; they name the line of the file.
Result<ReportTemplate> read_template(std::string_view toml);

}  // namespace dripline::report_template
