#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "protocol/base/result.hpp"

/// Statistics of measured values. Pure: no file, clock or lock; any thread. Values are plain
/// doubles in the unit of their characteristic; the caller keeps the unit.
namespace dripline::statistics {

/// Squares of larger numbers, and sums of them, leave a double.
inline constexpr double kMaxMagnitude = 1e100;
/// Errors: LimitExceeded, which names the first value that is too large or is no number.
Result<void> check_values(std::span<const double> values);

struct Summary {
  std::size_t count = 0;
  double mean = 0;
  double standard_deviation = 0;  ///< of a sample (n - 1); 0 for fewer than two values
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -std::numeric_limits<double>::infinity();
  double range() const { return count == 0 ? 0 : maximum - minimum; }
};

/// Sums with a running compensation (Neumaier), so that small terms are not lost beside large ones.
class CompensatedSum {
 public:
  void add(double term);
  double value() const { return sum_ + compensation_; }

 private:
  double sum_ = 0, compensation_ = 0;
};

/// One value at a time in constant memory (Welford's recurrence).
class RunningSummary {
 public:
  void add(double value);
  Summary summary() const;

 private:
  Summary summary_;
  double squares_ = 0;  ///< sum of squared deviations from the mean so far
};

/// Two passes: the mean first, then deviations from it with the rounding of the mean taken out
/// (Chan, Golub, LeVeque 1983).
Summary summarize(std::span<const double> values);

/// Coefficient of neighboring values about the common mean, as NIST StRD defines it. 0 where all
/// values are equal.
double lag_one_autocorrelation(std::span<const double> values);

/// The value below which the fraction `p` of ordered values lies, interpolated at p (n + 1), as the
/// NIST/SEMATECH e-Handbook 7.2.6.2 does; at most the largest and at least the smallest value.
/// `ordered` must not be empty.
double percentile(std::span<const double> ordered, double p);

}  // namespace dripline::statistics
