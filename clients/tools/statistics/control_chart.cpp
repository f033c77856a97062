#include "clients/tools/statistics/control_chart.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "clients/tools/statistics/chart_constants.hpp"
#include "clients/tools/statistics/summary.hpp"

namespace dripline::statistics {
namespace {

constexpr std::array kKinds{std::pair{ChartKind::Individuals, std::string_view("individuals")},
                            std::pair{ChartKind::MeanRange, std::string_view("xbar-r")},
                            std::pair{ChartKind::MeanDeviation, std::string_view("xbar-s")},
                            std::pair{ChartKind::Ewma, std::string_view("ewma")},
                            std::pair{ChartKind::Cusum, std::string_view("cusum")}};

using Statistic = double (*)(const Summary&);
double mean_of(const Summary& summary) {
  return summary.mean;
}
double range_of(const Summary& summary) {
  return summary.range();
}
double deviation_of(const Summary& summary) {
  return summary.standard_deviation;
}

std::vector<double> of_subgroups(std::span<const double> values, std::size_t size,
                                 Statistic statistic) {
  std::vector<double> points;
  points.reserve(values.size() / size);
  for (std::size_t i = 0; i + size <= values.size(); i += size) {
    points.push_back(statistic(summarize(values.subspan(i, size))));
  }
  return points;
}

std::vector<double> moving_ranges(std::span<const double> values) {
  std::vector<double> ranges;
  for (std::size_t i = 1; i < values.size(); ++i) {
    ranges.push_back(std::abs(values[i] - values[i - 1]));
  }
  return ranges;
}

Result<void> check_subgroup(ChartKind kind, std::size_t subgroup) {
  const std::size_t least = is_mean_chart(kind) ? 2 : 1;
  const std::size_t most = kind == ChartKind::Individuals ? 1 : kMaxSubgroup;
  if (subgroup >= least && subgroup <= most) return {};
  return fail(Errc::LimitExceeded, "{} with subgroups of {} values: {} to {} are possible",
              to_string(kind), subgroup, least, most);
}

struct Spread {
  double sigma = 0;
  std::string estimator;
};

Result<Spread> spread_of(std::span<const double> values, ChartKind kind, std::size_t subgroup) {
  if (subgroup == 1) {
    const auto constants = chart_constants(2);
    if (!constants) return fail(constants.error());
    return Spread{summarize(moving_ranges(values)).mean / constants->d2, "mean moving range / d2"};
  }
  const auto constants = chart_constants(subgroup);
  if (!constants) return fail(constants.error());
  if (kind == ChartKind::MeanDeviation) {
    return Spread{summarize(of_subgroups(values, subgroup, deviation_of)).mean / constants->c4,
                  "mean standard deviation / c4"};
  }
  return Spread{summarize(of_subgroups(values, subgroup, range_of)).mean / constants->d2,
                "mean range / d2"};
}

/// Points with the same limits everywhere.
Panel level_panel(std::string name, std::vector<double> points, double center, double lower,
                  double upper) {
  Panel panel;
  panel.name = std::move(name);
  panel.lower.assign(points.size(), lower);
  panel.upper.assign(points.size(), upper);
  panel.points = std::move(points);
  panel.center = center;
  return panel;
}

/// Marks what is beyond its own limits.
void mark_beyond(Panel& panel) {
  for (std::size_t i = 0; i < panel.points.size(); ++i) {
    const bool is_low = panel.lower_points.empty() ? panel.points[i] < panel.lower[i]
                                                   : panel.lower_points[i] < panel.lower[i];
    if (panel.points[i] > panel.upper[i] || is_low) {
      panel.violations.push_back({RuleSet::LimitsOnly, 1, i, i});
    }
  }
}

double sigma_of_points(const Baseline& baseline, const ChartSettings& settings) {
  return baseline.sigma / std::sqrt(static_cast<double>(settings.subgroup));
}

Panel location_panel(std::string name, std::vector<double> points, const Baseline& baseline,
                     const ChartSettings& settings) {
  const double sigma = sigma_of_points(baseline, settings);
  Panel panel = level_panel(std::move(name), std::move(points), baseline.center,
                            baseline.center - 3 * sigma, baseline.center + 3 * sigma);
  panel.violations = find_violations(panel.points, baseline.center, sigma, settings.rules);
  return panel;
}

/// The range or the deviation of subgroups of `size`.
Panel spread_panel(std::string name, std::vector<double> points, double center, double low_factor,
                   double high_factor) {
  Panel panel = level_panel(std::move(name), std::move(points), center, low_factor * center,
                            high_factor * center);
  mark_beyond(panel);
  return panel;
}

Result<std::vector<Panel>> shewhart(std::span<const double> values, const Baseline& baseline,
                                    const ChartSettings& settings) {
  const bool is_single = settings.kind == ChartKind::Individuals;
  const auto found = chart_constants(is_single ? 2 : settings.subgroup);
  if (!found) return fail(found.error());
  const ChartConstants& constants = *found;
  std::vector<Panel> panels;
  if (is_single) {
    panels.push_back(location_panel("X", {values.begin(), values.end()}, baseline, settings));
    panels.push_back(spread_panel("MR", moving_ranges(values), constants.d2 * baseline.sigma,
                                  constants.D3, constants.D4));
    panels.back().first = 1;
    return panels;
  }
  panels.push_back(location_panel("X-bar", of_subgroups(values, settings.subgroup, mean_of),
                                  baseline, settings));
  if (settings.kind == ChartKind::MeanRange) {
    panels.push_back(spread_panel("R", of_subgroups(values, settings.subgroup, range_of),
                                  constants.d2 * baseline.sigma, constants.D3, constants.D4));
  } else {
    panels.push_back(spread_panel("S", of_subgroups(values, settings.subgroup, deviation_of),
                                  constants.c4 * baseline.sigma, constants.B3, constants.B4));
  }
  return panels;
}

/// Limits with the factor 1 - (1 - lambda)^2i, which matters in the first points
/// (e-Handbook 6.3.2.4 leaves it out; Montgomery 9.2 has it).
Panel ewma_panel(const std::vector<double>& points, const Baseline& baseline,
                 const ChartSettings& settings) {
  const double weight = settings.ewma_weight;
  const double sigma = sigma_of_points(baseline, settings);
  Panel panel;
  panel.name = "EWMA";
  panel.center = baseline.center;
  double mean = baseline.center, faded = 1;
  for (const double point : points) {
    mean = weight * point + (1 - weight) * mean;
    faded *= (1 - weight) * (1 - weight);
    const double width =
        settings.ewma_width * sigma * std::sqrt(weight / (2 - weight) * (1 - faded));
    panel.points.push_back(mean);
    panel.lower.push_back(baseline.center - width);
    panel.upper.push_back(baseline.center + width);
  }
  mark_beyond(panel);
  return panel;
}

/// Tabular form (e-Handbook 6.3.2.3): sums of what is above the center plus k, and below the center
/// minus k.
Panel cusum_panel(const std::vector<double>& points, const Baseline& baseline,
                  const ChartSettings& settings) {
  const double sigma = sigma_of_points(baseline, settings);
  const double slack = settings.cusum_slack * sigma;
  const double decision = settings.cusum_decision * sigma;
  std::vector<double> above, below;
  double high = 0, low = 0;
  for (const double point : points) {
    high = std::max(0.0, high + point - baseline.center - slack);
    low = std::min(0.0, low + point - baseline.center + slack);
    above.push_back(high);
    below.push_back(low);
  }
  Panel panel = level_panel("CUSUM", std::move(above), 0, -decision, decision);
  panel.lower_points = std::move(below);
  mark_beyond(panel);
  return panel;
}

Result<void> check_settings(const ChartSettings& settings) {
  if (auto good = check_subgroup(settings.kind, settings.subgroup); !good) return good;
  if (!(settings.ewma_weight > 0 && settings.ewma_weight <= 1)) {
    return fail(Errc::LimitExceeded, "an EWMA weight of {}: above 0, at most 1",
                settings.ewma_weight);
  }
  if (settings.ewma_width > 0 && settings.cusum_slack >= 0 && settings.cusum_decision > 0)
    return {};
  return fail(Errc::LimitExceeded, "widths of EWMA and CUSUM must be above 0");
}

}  // namespace

std::string_view to_string(ChartKind kind) {
  return std::ranges::find(kKinds, kind, [](const auto& row) { return row.first; })->second;
}

bool is_mean_chart(ChartKind kind) {
  return kind == ChartKind::MeanRange || kind == ChartKind::MeanDeviation;
}

Result<ChartKind> parse_chart_kind(std::string_view name) {
  const auto* found = std::ranges::find(kKinds, name, [](const auto& row) { return row.second; });
  if (found != kKinds.end()) return found->first;
  return fail(Errc::Syntax, "chart '{}': individuals, xbar-r, xbar-s, ewma or cusum", name);
}

std::string to_text(const LimitsOrigin& origin) {
  if (!origin.is_computed) {
    return origin.source.empty() ? "limits fixed" : "limits fixed: " + origin.source;
  }
  return fmt::format("limits computed from {} values{}{}, by {}", origin.values,
                     origin.source.empty() ? "" : " of ", origin.source, origin.estimator);
}

Result<Baseline> estimate_baseline(std::span<const double> values, ChartKind kind,
                                   std::size_t subgroup, std::string source) {
  if (auto good = check_subgroup(kind, subgroup); !good) return fail(good.error());
  if (auto good = check_values(values); !good) return fail(good.error());
  const auto used = values.first(values.size() / subgroup * subgroup);
  if (used.size() < 2) {
    return fail(Errc::LimitExceeded, "limits from {} values: 2 or one full subgroup are needed",
                values.size());
  }
  const auto spread = spread_of(used, kind, subgroup);
  if (!spread) return fail(spread.error());
  if (!(spread->sigma > 0)) {
    return fail(Errc::Unsupported, "the {} values do not vary: no limits follow from them",
                used.size());
  }
  return Baseline{summarize(used).mean,
                  spread->sigma,
                  {true, used.size(), std::move(source), spread->estimator}};
}

Result<Baseline> fixed_baseline(double center, double sigma, std::string source) {
  if (!std::isfinite(center) || !(sigma > 0) || !std::isfinite(sigma)) {
    return fail(Errc::LimitExceeded, "fixed limits about {} with sigma {}: it must be above 0",
                center, sigma);
  }
  return Baseline{center, sigma, {false, 0, std::move(source), "fixed"}};
}

bool ControlChart::is_in_control() const {
  return std::ranges::all_of(panels, [](const Panel& panel) { return panel.violations.empty(); });
}

Result<ControlChart> make_control_chart(std::span<const double> values, const Baseline& baseline,
                                        const ChartSettings& settings) {
  if (auto good = check_settings(settings); !good) return fail(good.error());
  if (auto good = check_values(values); !good) return fail(good.error());
  if (values.size() < settings.subgroup) {
    return fail(Errc::LimitExceeded, "{} values, a point needs {}", values.size(),
                settings.subgroup);
  }
  ControlChart chart;
  chart.kind = settings.kind;
  chart.subgroup = settings.subgroup;
  chart.values = values.size() / settings.subgroup * settings.subgroup;
  chart.left_out = values.size() - chart.values;
  chart.baseline = baseline;
  const auto used = values.first(chart.values);
  if (settings.kind == ChartKind::Ewma) {
    chart.panels = {ewma_panel(of_subgroups(used, settings.subgroup, mean_of), baseline, settings)};
  } else if (settings.kind == ChartKind::Cusum) {
    chart.panels = {
        cusum_panel(of_subgroups(used, settings.subgroup, mean_of), baseline, settings)};
  } else {
    auto panels = shewhart(used, baseline, settings);
    if (!panels) return fail(panels.error());
    chart.panels = *std::move(panels);
  }
  return chart;
}

}  // namespace dripline::statistics
