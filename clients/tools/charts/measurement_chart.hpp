#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/tools/charts/pictures.hpp"
#include "protocol/measurement/measurement.hpp"

namespace dripline::charts {

/// What to draw of measurements: a kind of control chart, a histogram, or a trend by tool life.
struct ChartRequest {
  std::string kind = "individuals";  ///< that of statistics::to_string, histogram or trend
  statistics::ChartSettings settings = {};
  /// Fixed limits: both, and why. Absent: computed.
  std::optional<double> center, sigma;
  std::string limits_note;
  std::size_t baseline =
      0;  ///< limits are computed from so many values at the beginning; 0: from all
  statistics::CapabilitySettings capability = {};
  std::vector<UtcTime> tool_changes =
      {};             ///< trend: a life ends there, besides where the tool's name changes
  std::string title;  ///< empty: characteristic and machine
  double width = 960, height = 600;
};

/// From names and texts as a query or a command line has them: kind, subgroup, rules, center,
/// sigma, limits_note, baseline, lambda, slack, decision, shape, confidence, title, width, height.
/// Errors: Syntax (an unknown name, no number), LimitExceeded.
Result<ChartRequest> parse_chart_request(const std::map<std::string, std::string>& texts);

/// The values must be of one characteristic, in the order of time. Errors: LimitExceeded (too few,
/// a number beyond kMaxMagnitude), Conflict (of several characteristics or units), Syntax (the
/// kind), those of statistics.
Result<void> draw_measurements(Canvas& canvas,
                               std::span<const measurement::Measurement> measurements,
                               const ChartRequest& request);

/// Which runs, from when to when: "runs 1f3a09c2 to 77b0de11, 2026-11-02 to 2026-11-20".
std::string source_text(std::span<const measurement::Measurement> measurements);

/// The picture as SVG.
Result<std::string> measurements_svg(std::span<const measurement::Measurement> measurements,
                                     const ChartRequest& request);

}  // namespace dripline::charts
