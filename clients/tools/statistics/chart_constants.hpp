#pragma once

#include <cstddef>

#include "protocol/base/result.hpp"

namespace dripline::statistics {

/// What relates ranges and standard deviations of small samples of a normal distribution to its
/// sigma. The letters are those of ISO 7870-2 and ASTM E2587.
struct ChartConstants {
  double d2 = 0, d3 = 0;  ///< mean and standard deviation of the range, in sigma
  double c4 = 0;          ///< mean of the sample's standard deviation, in sigma
  double A2 = 0, A3 = 0;  ///< limits of the mean from the mean range, the mean deviation
  double B3 = 0, B4 = 0;  ///< limits of the standard deviation, in mean deviations
  double D3 = 0, D4 = 0;  ///< limits of the range, in mean ranges
  double E2 = 0;          ///< limits of single values from the mean range
};

inline constexpr std::size_t kMaxSubgroup = 100;

/// For samples of `size` values. Computed from the distribution of the range, by numerical
/// integration once and then kept. Errors: LimitExceeded (fewer than 2, more than kMaxSubgroup).
Result<ChartConstants> chart_constants(std::size_t size);

/// The d2 of a mean of only `ranges` ranges (Duncan), of which the AIAG's K factors are the
/// inverse. Errors: LimitExceeded (as above; no range).
Result<double> d2_of_few_ranges(std::size_t size, std::size_t ranges);

/// Which K of the AIAG's average and range method.
enum class GaugeFactor {
  Trials,      ///< K1: of the mean range of many cells
  Appraisers,  ///< K2: of the range of their means
  Parts,       ///< K3: the same
};
/// With the four digits of the AIAG's form (Measurement Systems Analysis, 4th edition, figure III-B
/// 16) where it has them (2 and 3 trials, 2 and 3 appraisers, 2 to 10 parts), so that a study
/// agrees with the form filled in by hand; computed beyond. Errors: LimitExceeded.
Result<double> gauge_factor(GaugeFactor factor, std::size_t size);

}  // namespace dripline::statistics
