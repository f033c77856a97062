#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "clients/tools/statistics/summary.hpp"
#include "protocol/base/result.hpp"

namespace dripline::statistics {

/// What is still good; at least one of the two.
struct Tolerance {
  std::optional<double> lower, upper;
};

struct Interval {
  double low = 0, high = 0;
};

/// An index with its two-sided confidence interval, where there is a formula for it.
struct Index {
  double value = 0;
  std::optional<Interval> interval;
};

enum class Shape : std::uint8_t {
  Normal,
  LogNormal,  ///< for what cannot be below 0: runout, roughness, time
  Empirical,  ///< the values' own percentiles; needs very many of them
};
std::string_view to_string(Shape shape);  ///< normal, lognormal, empirical
/// Errors: Syntax.
Result<Shape> parse_shape(std::string_view name);

/// The three percentiles that take the place of mean and +-3 sigma (ISO 22514-2).
struct Percentiles {
  double low = 0, median = 0, high = 0;  ///< 0.135 %, 50 %, 99.865 %
};

struct CapabilitySettings {
  std::size_t subgroup = 1;  ///< 1: sigma within by the moving range
  double confidence = 0.95;
  Shape shape = Shape::Normal;
};

/// Cp and Cpk compare the tolerance with the variation within subgroups, Pp and Ppk with that of
/// all values. Cp and Pp need both limits. Of a shape that is not normal there are Pp and Ppk
/// alone, by percentiles and without intervals.
struct Capability {
  Summary summary;
  Shape shape = Shape::Normal;
  double confidence = 0;
  double sigma_within = 0;    ///< normal alone
  double degrees_within = 0;  ///< of freedom: 1 / (2 * relative variance of sigma_within)
  std::string within_by;      ///< the estimator
  Percentiles percentiles;
  std::optional<Index> cp, cpk, pp, ppk;
  std::size_t below = 0, above = 0;  ///< values outside the tolerance
  double expected_outside = 0;       ///< parts per million, by the shape and all values
  bool is_percentile_reached =
      true;  ///< false: fewer values than the percentiles of Empirical need (741)
};

/// Intervals: Cp and Pp by chi-squared (exact for normal values), Cpk and Ppk by Bissell, Applied
/// Statistics 39 (1990): the index +- z * sqrt(1 / 9n + index^2 / 2v). Errors: LimitExceeded (fewer
/// than 5 values, no limit, limits not in order, confidence), Unsupported (no variation; LogNormal
/// with values of 0 and less).
Result<Capability> capability(std::span<const double> values, const Tolerance& tolerance,
                              const CapabilitySettings& settings);

/// The two intervals by themselves: `degrees` of freedom of sigma, `count` values of the mean.
Interval chi_squared_interval(double index, double degrees, double confidence);
Interval bissell_interval(double index, std::size_t count, double degrees, double confidence);

}  // namespace dripline::statistics
