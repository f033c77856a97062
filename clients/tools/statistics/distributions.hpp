#pragma once

/// The few functions of distributions that the rest needs, so that Boost.Math is read by one file.
namespace dripline::statistics {

double normal_density(double z);
double normal_cumulative(double z);
/// 0 < p < 1.
double normal_quantile(double p);
/// 0 < p < 1; `degrees` > 0, which need not be whole.
double chi_squared_quantile(double p, double degrees);
/// Probability that a ratio of two variances is above `f` by chance.
double f_upper_tail(double f, double numerator_degrees, double denominator_degrees);

}  // namespace dripline::statistics
