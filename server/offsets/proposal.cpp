#include "server/offsets/proposal.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "clients/tools/statistics/summary.hpp"

namespace dripline::offsets {
namespace {

/// Of a normal distribution: its deviation in median absolute deviations.
constexpr double kDeviationsOfMad = 1.4826;

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(half));
  const double upper = values[half];
  if (values.size() % 2 == 1) return upper;
  return (upper + *std::ranges::max_element(values.begin(),
                                            values.begin() + static_cast<std::ptrdiff_t>(half))) /
         2;
}

/// Values that are nearly all equal have no spread of their own; then one in the last written digit
/// counts as one.
bool is_outlier(double value, double middle, double spread, const OffsetRule& rule) {
  const double least = std::pow(10.0, -rule.decimals);
  return rule.outlier > 0 && std::abs(value - middle) > rule.outlier * std::max(spread, least);
}

std::vector<Deviation> without_outliers(std::span<const Deviation> deviations,
                                        const OffsetRule& rule) {
  std::vector<double> values, distances;
  for (const Deviation& one : deviations) values.push_back(one.value);
  const double middle = median(values);
  for (const double value : values) distances.push_back(std::abs(value - middle));
  const double spread = kDeviationsOfMad * median(distances);
  std::vector<Deviation> kept;
  std::ranges::copy_if(deviations, std::back_inserter(kept), [&](const Deviation& one) {
    return !is_outlier(one.value, middle, spread, rule);
  });
  return kept;
}

double rounded(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

class Reasoning {
 public:
  Reasoning(Outcome& outcome, const OffsetRule& rule, std::string_view unit)
      : outcome_(outcome), rule_(rule), unit_(unit.empty() ? "" : fmt::format(" {}", unit)) {}

  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    outcome_.reasons.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  bool is_enough(std::size_t count) {
    if (count >= rule_.min_count) return true;
    const std::string scope = scope_text(rule_);
    say("{} measurements {}{}under the value in force, {} are needed", count, scope,
        scope.empty() ? "" : " ", rule_.min_count);
    return false;
  }

  void use(std::span<const Deviation> kept) {
    statistics::RunningSummary running;
    for (const Deviation& one : kept) running.add(one.value);
    const auto summary = running.summary();
    outcome_.used = kept.size();
    outcome_.mean = summary.mean;
    outcome_.first = kept.front().measurement;
    outcome_.last = kept.back().measurement;
    say("mean deviation {:+.5g}{} of {} measurements, standard deviation {:.3g}", summary.mean,
        unit_, summary.count, summary.standard_deviation);
  }

  void decide(double value) {
    const double mean = outcome_.mean;
    if (std::abs(mean) < rule_.dead_band)
      return say("it is within the dead band of {:g}", rule_.dead_band);
    double step = -rule_.gain * rule_.scale * mean;
    say("step {:+.5g}: gain {:g}, scale {:g}", step, rule_.gain, rule_.scale);
    const bool is_limited = !is_at_most(std::abs(step), rule_.max_step);
    if (is_limited) {
      step = std::copysign(rule_.max_step, step);
      say("limited to the largest step, {:g}: so a person decides", rule_.max_step);
    }
    double next = rounded(value + step, rule_.decimals);
    const bool is_too_far = !is_at_most(std::abs(next - value), rule_.max_step);
    if (is_too_far && next != rounded(value, rule_.decimals)) {  // by its last digit
      next = rounded(next - std::copysign(std::pow(10.0, -rule_.decimals), step), rule_.decimals);
    }
    if (next == rounded(value, rule_.decimals))
      return say("that changes no digit of {:.{}f}", value, rule_.decimals);
    if ((rule_.lowest && next < *rule_.lowest) || (rule_.highest && next > *rule_.highest)) {
      return say("{:.{}f} would leave the bounds {:g} to {:g}: the tool or the rule needs a person",
                 next, rule_.decimals, rule_.lowest.value_or(-HUGE_VAL),
                 rule_.highest.value_or(HUGE_VAL));
    }
    say("{:.{}f} becomes {:.{}f}", value, rule_.decimals, next, rule_.decimals);
    outcome_.new_value = next;
    outcome_.is_within_policy =
        !is_limited && rule_.automatic > 0 && is_at_most(std::abs(next - value), rule_.automatic);
  }

 private:
  Outcome& outcome_;
  const OffsetRule& rule_;
  std::string unit_;  ///< with a blank before it
};

}  // namespace

/// A step is the difference of values of up to some thousands, with at most 9 decimals.
bool is_at_most(double step, double limit) {
  constexpr double kRounding = 1e-10;
  return step <= limit + kRounding;
}

Outcome propose(std::span<const Deviation> deviations, double value, const OffsetRule& rule,
                std::string_view unit) {
  Outcome outcome;
  Reasoning reasoning(outcome, rule, unit);
  std::vector<Deviation> finite;
  std::ranges::copy_if(deviations, std::back_inserter(finite),
                       [](const Deviation& one) { return std::isfinite(one.value); });
  const std::size_t taken = std::min(rule.window, finite.size());
  const auto newest = std::span<const Deviation>(finite).last(taken);
  if (!reasoning.is_enough(newest.size())) return outcome;
  const auto kept = without_outliers(newest, rule);
  outcome.left_out = newest.size() - kept.size();
  if (outcome.left_out > 0) {
    reasoning.say("{} of {} left out: over {:g} robust deviations from the median",
                  outcome.left_out, newest.size(), rule.outlier);
  }
  if (!reasoning.is_enough(kept.size())) return outcome;
  reasoning.use(kept);
  reasoning.decide(value);
  return outcome;
}

}  // namespace dripline::offsets
