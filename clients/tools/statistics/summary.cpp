#include "clients/tools/statistics/summary.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::statistics {

Result<void> check_values(std::span<const double> values) {
  const auto bad = std::ranges::find_if_not(
      values, [](double value) { return std::abs(value) <= kMaxMagnitude; });
  if (bad == values.end()) return {};
  return fail(Errc::LimitExceeded, "value {} of {} is {:g}: {:g} to {:g} can be computed with",
              bad - values.begin() + 1, values.size(), *bad, -kMaxMagnitude, kMaxMagnitude);
}

void CompensatedSum::add(double term) {
  const double sum = sum_ + term;
  compensation_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
  sum_ = sum;
}

void RunningSummary::add(double value) {
  ++summary_.count;
  const double from_old = value - summary_.mean;
  summary_.mean += from_old / static_cast<double>(summary_.count);
  squares_ += from_old * (value - summary_.mean);
  summary_.minimum = std::min(summary_.minimum, value);
  summary_.maximum = std::max(summary_.maximum, value);
}

Summary RunningSummary::summary() const {
  Summary result = summary_;
  if (result.count > 1) {
    result.standard_deviation = std::sqrt(squares_ / static_cast<double>(result.count - 1));
  }
  return result;
}

Summary summarize(std::span<const double> values) {
  Summary result;
  result.count = values.size();
  if (values.empty()) return result;
  const auto count = static_cast<double>(values.size());
  CompensatedSum sum;
  for (const double value : values) sum.add(value);
  result.mean = sum.value() / count;
  CompensatedSum deviations, squares;
  for (const double value : values) {
    const double deviation = value - result.mean;
    deviations.add(deviation);
    squares.add(deviation * deviation);
    result.minimum = std::min(result.minimum, value);
    result.maximum = std::max(result.maximum, value);
  }
  if (values.size() > 1) {
    const double correction = deviations.value() * deviations.value() / count;
    result.standard_deviation =
        std::sqrt(std::max(0.0, squares.value() - correction) / (count - 1));
  }
  return result;
}

double lag_one_autocorrelation(std::span<const double> values) {
  const double mean = summarize(values).mean;
  CompensatedSum products, squares;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double deviation = values[i] - mean;
    squares.add(deviation * deviation);
    if (i > 0) products.add(deviation * (values[i - 1] - mean));
  }
  return squares.value() == 0 ? 0 : products.value() / squares.value();
}

double percentile(std::span<const double> ordered, double p) {
  const double place = p * static_cast<double>(ordered.size() + 1);
  if (place <= 1) return ordered.front();
  if (place >= static_cast<double>(ordered.size())) return ordered.back();
  const double whole = std::floor(place);
  const auto below = static_cast<std::size_t>(whole) - 1;
  return ordered[below] + (place - whole) * (ordered[below + 1] - ordered[below]);
}

}  // namespace dripline::statistics
