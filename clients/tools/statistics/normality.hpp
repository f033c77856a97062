#pragma once

#include <cstddef>
#include <span>

#include "protocol/base/result.hpp"

namespace dripline::statistics {

struct AndersonDarling {
  double statistic = 0;  ///< A squared, as computed
  double adjusted = 0;   ///< for mean and deviation being estimated: times 1 + 0.75/n + 2.25/n^2
  double p_value = 0;    ///< chance of a value as large where the values are normal
  std::size_t count = 0;
};

inline constexpr std::size_t kMinNormalityValues = 8;

/// Whether values may come from a normal distribution whose mean and deviation are not known.
/// Sources: Anderson and Darling (1954); D'Agostino and Stephens, Goodness-of-Fit Techniques
/// (1986), section 4.8.5, for the adjustment and the p-value. Errors: LimitExceeded (fewer than
/// kMinNormalityValues), Unsupported (all values are equal).
Result<AndersonDarling> anderson_darling(std::span<const double> values);

}  // namespace dripline::statistics
