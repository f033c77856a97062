#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "clients/tools/offline/check_summary.hpp"

namespace dripline::cli {

/// A finished check of one file.
struct CheckReport {
  /// A place where the program stops for the operator.
  struct ProgrammedStop {
    interpreter::Stop stop;
    std::uint64_t times = 0;  ///< that it is met
    std::string block;        ///< its text
  };
  struct ProgrammedStops {
    std::vector<ProgrammedStop> places;  ///< as they are met; the first of them only
    std::uint64_t count = 0;             ///< times of all places
  };

  std::string file;
  /// Files of called programs, by their ProgramIndex less one.
  std::vector<std::string> called{};
  interpreter::Summary summary;
  double elapsed_seconds = 0;  ///< that the check took
  /// The state of the machine after the block at which the check was to stop.
  std::optional<interpreter::MachineState> stopped{};
  std::optional<ProgrammedStops> stops{};  ///< where they were asked for
};

/// Warnings, alarm and stops as FILE:LINE:COLUMN lines, FILE being the called program's own where
/// they are in one, then the summary. Lengths in the program's units, X as it is programmed.
std::string check_text(const CheckReport& report, bool has_color);

/// {"file", "control", "program", "ended", "blocks", "moves", "units", "x", "rapid_length",
/// "feed_length", "seconds", "extents": {"X": {"min", "max"}}, "warnings": [{"code", "text",
/// "line", "column", "file"}], "warning_count", "alarm": null or as a warning, "elapsed_seconds",
/// "blocks_per_second"}, and where it was to end at a block "stopped": null or {"block", "line",
/// "position", "tool", "spindle", "speed", "feed", "flood", "mist"}; where stops were asked for
/// "stops": [{"file", "line", "block": null or its number, "kind", "text", "times"}] and
/// "stop_count". At most 1000 warnings and stops are listed; the counts have them all.
nlohmann::ordered_json check_json(const CheckReport& report);

}  // namespace dripline::cli
