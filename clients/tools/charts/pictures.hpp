#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/charts/canvas.hpp"
#include "clients/tools/charts/contour.hpp"
#include "clients/tools/statistics/capability.hpp"
#include "clients/tools/statistics/control_chart.hpp"
#include "clients/tools/statistics/histogram.hpp"
#include "protocol/base/result.hpp"

namespace dripline::charts {

/// What every picture carries in words.
struct Caption {
  std::string title;     ///< the characteristic, its machine
  std::string subtitle;  ///< from when to when, which part; may be empty
  std::string unit;
};

/// Below this nothing can be read.
inline constexpr double kMinWidth = 320, kMinHeight = 240;
inline constexpr double kMaxSide = 8192;
/// Larger numbers, of either sign, are in no picture: squares and sums of them leave a double.
inline constexpr double kMaxMagnitude = 1e15;
/// Errors: LimitExceeded, which names `what` and the value.
Result<void> check_magnitude(std::string_view what, double value);

/// Its panels one below the other, limits and center with their values; count, origin of the limits
/// and what the rules found in words below.
void draw_control_chart(Canvas& canvas, const statistics::ControlChart& chart,
                        const Caption& caption);

struct HistogramPicture {
  statistics::Histogram histogram;
  statistics::Summary summary;
  statistics::Tolerance tolerance;
  std::optional<double> nominal;
  std::optional<statistics::Capability> capability;
};
/// With the limits of the tolerance and the normal curve of the values' mean and deviation.
void draw_histogram(Canvas& canvas, const HistogramPicture& picture, const Caption& caption);

struct TrendPoint {
  double life = 0;  ///< parts or minutes since the tool came
  double value = 0;
};
/// What one tool (one edge) measured from its change to the next.
struct ToolLife {
  std::string tool;
  std::vector<TrendPoint> points;
};
struct TrendPicture {
  std::vector<ToolLife> lives;
  statistics::Tolerance tolerance;
  std::optional<double> nominal;
  std::string life_unit = "parts since the tool change";
};
/// Every life from the same zero, with a straight line through it and its slope.
void draw_trend(Canvas& canvas, const TrendPicture& picture, const Caption& caption);

struct ProfilePicture {
  std::vector<ContourPoint> nominal, actual;
  std::string first_axis = "X", second_axis = "Z";
  std::optional<double> lower, upper;   ///< of the deviation
  std::optional<double> magnification;  ///< of the deviation; absent: a round one
};
/// The nominal contour with the magnified deviations on it, and below the deviations along the
/// contour. Errors: as deviations(); LimitExceeded (limits or a magnification that are too large).
Result<void> draw_profile(Canvas& canvas, const ProfilePicture& picture, const Caption& caption);

}  // namespace dripline::charts
