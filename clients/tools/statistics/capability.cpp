#include "clients/tools/statistics/capability.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "clients/tools/statistics/chart_constants.hpp"
#include "clients/tools/statistics/control_chart.hpp"
#include "clients/tools/statistics/distributions.hpp"

namespace dripline::statistics {
namespace {

constexpr std::size_t kMinValues = 5;
constexpr double kLowFraction = 0.00135, kHighFraction = 0.99865;
constexpr double kPi = 3.14159265358979323846;

/// Degrees of freedom from the relative variance of the estimator of sigma, 1 / 2v to first order.
/// Neighboring moving ranges share a value; the covariance of two folded normal values with
/// correlation -1/2 is part of theirs.
double degrees_within(std::size_t values, std::size_t subgroup, const ChartConstants& constants) {
  if (subgroup > 1) {
    const double relative = constants.d3 / constants.d2;
    return static_cast<double>(values / subgroup) / (2 * relative * relative);
  }
  const double square = 4 / kPi;  // of the mean range, in sigma
  const double own = 2 - square;  // variance of one
  const double product = 4 / kPi * (std::sqrt(0.75) + 0.5 * std::asin(0.5));
  const double relative = (own + 2 * (product - square)) / square;
  return static_cast<double>(values - 1) / (2 * relative);
}

Result<void> check(std::span<const double> values, const Tolerance& tolerance,
                   const CapabilitySettings& settings) {
  if (values.size() < kMinValues) {
    return fail(Errc::LimitExceeded, "capability of {} values, it needs {}", values.size(),
                kMinValues);
  }
  if (!tolerance.lower && !tolerance.upper)
    return fail(Errc::LimitExceeded, "capability without a limit");
  if (tolerance.lower && tolerance.upper && !(*tolerance.lower < *tolerance.upper)) {
    return fail(Errc::LimitExceeded, "lower limit {} is not below the upper {}", *tolerance.lower,
                *tolerance.upper);
  }
  for (const auto& limit : {tolerance.lower, tolerance.upper}) {
    if (limit && !(std::abs(*limit) <= kMaxMagnitude)) {
      return fail(Errc::LimitExceeded, "a limit of {:g}: {:g} to {:g} can be computed with", *limit,
                  -kMaxMagnitude, kMaxMagnitude);
    }
  }
  if (settings.confidence > 0.5 && settings.confidence < 1) return check_values(values);
  return fail(Errc::LimitExceeded, "a confidence of {}: between 0.5 and 1", settings.confidence);
}

/// The wider the better: the tolerance in units of what is above and below the middle.
struct Fit {
  std::optional<double> both, nearest;
};
Fit fit(const Tolerance& tolerance, const Percentiles& at) {
  Fit result;
  const auto keep = [&](double index) {
    result.nearest = std::min(result.nearest.value_or(index), index);
  };
  if (tolerance.upper) keep((*tolerance.upper - at.median) / (at.high - at.median));
  if (tolerance.lower) keep((at.median - *tolerance.lower) / (at.median - at.low));
  if (tolerance.lower && tolerance.upper) {
    result.both = (*tolerance.upper - *tolerance.lower) / (at.high - at.low);
  }
  return result;
}

/// What a double cannot tell apart has no index.
Result<void> check_spread(const Percentiles& at) {
  if (at.low < at.median && at.median < at.high && std::isfinite(at.high)) return {};
  return fail(Errc::Unsupported, "the values about {:g} vary too little", at.median);
}

Percentiles normal_percentiles(double mean, double sigma) {
  return {mean - 3 * sigma, mean, mean + 3 * sigma};
}

/// Fills both indices of one sigma.
void add_normal(std::optional<Index>& both, std::optional<Index>& nearest, const Fit& of,
                std::size_t count, double degrees, double confidence) {
  if (of.both) both = Index{*of.both, chi_squared_interval(*of.both, degrees, confidence)};
  nearest = Index{*of.nearest, bissell_interval(*of.nearest, count, degrees, confidence)};
}

double normal_outside(const Tolerance& tolerance, double mean, double sigma) {
  double part = 0;
  if (tolerance.lower) part += normal_cumulative((*tolerance.lower - mean) / sigma);
  if (tolerance.upper) part += normal_cumulative((mean - *tolerance.upper) / sigma);
  return part * 1e6;
}

Result<void> add_normal_indices(Capability& result, std::span<const double> values,
                                const Tolerance& tolerance, const CapabilitySettings& settings) {
  const auto kind = settings.subgroup > 1 ? ChartKind::MeanRange : ChartKind::Individuals;
  const auto within = estimate_baseline(values, kind, settings.subgroup, "");
  if (!within) return fail(within.error());
  const auto constants = chart_constants(std::max<std::size_t>(2, settings.subgroup));
  if (!constants) return fail(constants.error());
  const Summary& summary = result.summary;
  result.percentiles = normal_percentiles(summary.mean, summary.standard_deviation);
  const Percentiles of_within = normal_percentiles(summary.mean, within->sigma);
  for (const Percentiles& at : {result.percentiles, of_within}) {
    if (auto good = check_spread(at); !good) return good;
  }
  result.sigma_within = within->sigma;
  result.within_by = within->origin.estimator;
  result.degrees_within = degrees_within(within->origin.values, settings.subgroup, *constants);
  add_normal(result.cp, result.cpk, fit(tolerance, of_within), summary.count, result.degrees_within,
             settings.confidence);
  add_normal(result.pp, result.ppk, fit(tolerance, result.percentiles), summary.count,
             static_cast<double>(summary.count - 1), settings.confidence);
  result.expected_outside = normal_outside(tolerance, summary.mean, summary.standard_deviation);
  return {};
}

void add_percentile_indices(Capability& result, const Tolerance& tolerance) {
  const Fit of = fit(tolerance, result.percentiles);
  if (of.both) result.pp = Index{*of.both, {}};
  result.ppk = Index{*of.nearest, {}};
}

Result<void> add_lognormal(Capability& result, std::span<const double> values,
                           const Tolerance& tolerance) {
  if (result.summary.minimum <= 0) {
    return fail(Errc::Unsupported, "lognormal: the smallest value is {}, it must be above 0",
                result.summary.minimum);
  }
  std::vector<double> logarithms(values.begin(), values.end());
  for (double& value : logarithms) value = std::log(value);
  const Summary of = summarize(logarithms);
  result.percentiles = {std::exp(of.mean - 3 * of.standard_deviation), std::exp(of.mean),
                        std::exp(of.mean + 3 * of.standard_deviation)};
  if (auto good = check_spread(result.percentiles); !good) return good;
  Tolerance scaled;
  if (tolerance.upper && *tolerance.upper > 0) scaled.upper = std::log(*tolerance.upper);
  if (tolerance.lower && *tolerance.lower > 0) scaled.lower = std::log(*tolerance.lower);
  result.expected_outside = normal_outside(scaled, of.mean, of.standard_deviation);
  add_percentile_indices(result, tolerance);
  return {};
}

Result<void> add_empirical(Capability& result, std::span<const double> values,
                           const Tolerance& tolerance) {
  std::vector<double> ordered(values.begin(), values.end());
  std::ranges::sort(ordered);
  result.percentiles = {percentile(ordered, kLowFraction), percentile(ordered, 0.5),
                        percentile(ordered, kHighFraction)};
  result.is_percentile_reached = kLowFraction * static_cast<double>(ordered.size() + 1) >= 1;
  if (result.percentiles.high == result.percentiles.median ||
      result.percentiles.low == result.percentiles.median) {
    return fail(Errc::Unsupported, "half of the values are one value: they have no percentiles");
  }
  result.expected_outside =
      1e6 * static_cast<double>(result.below + result.above) / static_cast<double>(ordered.size());
  add_percentile_indices(result, tolerance);
  return {};
}

}  // namespace

std::string_view to_string(Shape shape) {
  switch (shape) {
    case Shape::LogNormal:
      return "lognormal";
    case Shape::Empirical:
      return "empirical";
    default:
      return "normal";
  }
}

Result<Shape> parse_shape(std::string_view name) {
  for (const Shape shape : {Shape::Normal, Shape::LogNormal, Shape::Empirical}) {
    if (name == to_string(shape)) return shape;
  }
  return fail(Errc::Syntax, "shape '{}': normal, lognormal or empirical", name);
}

Interval chi_squared_interval(double index, double degrees, double confidence) {
  const double tail = (1 - confidence) / 2;
  return {index * std::sqrt(chi_squared_quantile(tail, degrees) / degrees),
          index * std::sqrt(chi_squared_quantile(1 - tail, degrees) / degrees)};
}

Interval bissell_interval(double index, std::size_t count, double degrees, double confidence) {
  const double z = normal_quantile(1 - (1 - confidence) / 2);
  const double width =
      z * std::sqrt(1 / (9 * static_cast<double>(count)) + index * index / (2 * degrees));
  return {index - width, index + width};
}

Result<Capability> capability(std::span<const double> values, const Tolerance& tolerance,
                              const CapabilitySettings& settings) {
  if (auto good = check(values, tolerance, settings); !good) return fail(good.error());
  Capability result;
  result.summary = summarize(values);
  result.shape = settings.shape;
  result.confidence = settings.confidence;
  if (!(result.summary.standard_deviation > 0)) {
    return fail(Errc::Unsupported, "the {} values do not vary", result.summary.count);
  }
  for (const double value : values) {
    if (tolerance.lower && value < *tolerance.lower) ++result.below;
    if (tolerance.upper && value > *tolerance.upper) ++result.above;
  }
  Result<void> added;
  if (settings.shape == Shape::LogNormal) {
    added = add_lognormal(result, values, tolerance);
  } else if (settings.shape == Shape::Empirical) {
    added = add_empirical(result, values, tolerance);
  } else {
    added = add_normal_indices(result, values, tolerance, settings);
  }
  if (!added) return fail(added.error());
  return result;
}

}  // namespace dripline::statistics
