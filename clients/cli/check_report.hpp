#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gateway/interpreter/trace/check_summary.hpp"

namespace dripline::cli {

/// A finished check of one file.
struct CheckReport {
  std::string file;
  interpreter::Summary summary;
  double elapsed_seconds = 0;  ///< that the check took
};

/// Warnings and alarm as FILE:LINE:COLUMN lines, then the summary. Lengths in the program's units,
/// X as it is programmed.
std::string check_text(const CheckReport& report, bool has_colour);

/// {"file", "control", "program", "ended", "blocks", "moves", "units", "x", "rapid_length",
/// "feed_length", "seconds", "extents": {"X": {"min", "max"}}, "warnings": [{"code", "text",
/// "line", "column"}], "warning_count", "alarm": null or as a warning, "elapsed_seconds",
/// "blocks_per_second"}. At most 1000 warnings are listed; warning_count has them all.
nlohmann::ordered_json check_json(const CheckReport& report);

}  // namespace dripline::cli
