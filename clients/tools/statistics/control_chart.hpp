#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/statistics/rules.hpp"
#include "protocol/base/result.hpp"

namespace dripline::statistics {

enum class ChartKind : std::uint8_t {
  Individuals,    ///< single values and their moving range
  MeanRange,      ///< X-bar and R
  MeanDeviation,  ///< X-bar and S
  Ewma,
  Cusum,
};
std::string_view to_string(ChartKind kind);  ///< individuals, xbar-r, xbar-s, ewma, cusum
/// X-bar and R, X-bar and S: its points are means of subgroups.
bool is_mean_chart(ChartKind kind);
/// Errors: Syntax.
Result<ChartKind> parse_chart_kind(std::string_view name);

/// Where center and sigma come from. A chart without it cannot be judged.
struct LimitsOrigin {
  bool is_computed = true;  ///< from values; otherwise fixed by a person
  std::size_t values = 0;   ///< that they were computed from
  std::string source;       ///< which runs and time, or who fixed them and why
  std::string estimator;    ///< "mean moving range / d2", "mean range / d2", ...
};
std::string to_text(const LimitsOrigin& origin);

/// What the process does while it is in control: the center and the sigma of single values. All
/// limits follow from the two.
struct Baseline {
  double center = 0, sigma = 0;
  LimitsOrigin origin;
};

/// Estimates both from values: the sigma of a chart's kind is that of its own second panel; EWMA
/// and CUSUM take the moving range for single values and the mean range for subgroups. Values after
/// the last full subgroup are left out. `source`: for the origin. Errors: LimitExceeded (too few
/// values, subgroup size), Unsupported (no variation, not finite).
Result<Baseline> estimate_baseline(std::span<const double> values, ChartKind kind,
                                   std::size_t subgroup, std::string source);
/// Fixed by a person. Errors: LimitExceeded (sigma not above 0).
Result<Baseline> fixed_baseline(double center, double sigma, std::string source);

struct ChartSettings {
  ChartKind kind = ChartKind::Individuals;
  std::size_t subgroup = 1;  ///< values a point; at least 2 for X-bar
  RuleSet rules = RuleSet::LimitsOnly;
  double ewma_weight = 0.2;   ///< lambda
  double ewma_width = 3;      ///< limits, in sigma of the weighted mean
  double cusum_slack = 0.5;   ///< k, in sigma of the points
  double cusum_decision = 5;  ///< h, in sigma of the points
};

/// One row of points with its own limits, below the others in a picture.
struct Panel {
  std::string name;  ///< X, MR, X-bar, R, S, EWMA, CUSUM
  std::vector<double> points;
  std::vector<double> lower_points;  ///< CUSUM: the sums below, as values of 0 and less
  double center = 0;
  std::vector<double> lower, upper;  ///< limits at each point
  std::size_t first = 0;  ///< index of the point that points[0] belongs to: 1 for a moving range
  std::vector<Violation> violations;  ///< CUSUM and EWMA: beyond the limits
};

struct ControlChart {
  ChartKind kind = ChartKind::Individuals;
  std::size_t subgroup = 1;
  std::size_t values = 0;    ///< in the points
  std::size_t left_out = 0;  ///< after the last full subgroup
  Baseline baseline;
  std::vector<Panel> panels;
  bool is_in_control() const;
};

/// Rules beyond the first apply to the first panel of the Shewhart charts. Errors: LimitExceeded
/// (settings, no full subgroup, a value that is not finite).
Result<ControlChart> make_control_chart(std::span<const double> values, const Baseline& baseline,
                                        const ChartSettings& settings);

}  // namespace dripline::statistics
