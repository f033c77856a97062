#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "gateway/interpreter/trace/check_summary.hpp"
#include "gateway/interpreter/trace/machine_state.hpp"

namespace dripline::cli {

/// A finished check of one file.
struct CheckReport {
  std::string file;
  interpreter::Summary summary;
  double elapsed_seconds = 0;  ///< that the check took
  /// How the machine stands behind the block that the check was to end at.
  std::optional<interpreter::MachineState> stopped{};
};

/// Warnings and alarm as FILE:LINE:COLUMN lines, then the summary. Lengths in the program's units,
/// X as it is programmed.
std::string check_text(const CheckReport& report, bool has_colour);

/// {"file", "control", "program", "ended", "blocks", "moves", "units", "x", "rapid_length",
/// "feed_length", "seconds", "extents": {"X": {"min", "max"}}, "warnings": [{"code", "text",
/// "line", "column"}], "warning_count", "alarm": null or as a warning, "elapsed_seconds",
/// "blocks_per_second"}, and where it was to end at a block "stopped": null or {"block", "line",
/// "position", "tool", "spindle", "speed", "feed", "flood", "mist"}. At most 1000 warnings are
/// listed; warning_count has them all.
nlohmann::ordered_json check_json(const CheckReport& report);

}  // namespace dripline::cli
