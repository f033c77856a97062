#include "clients/tools/statistics/gauge_study.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "clients/tools/statistics/chart_constants.hpp"
#include "clients/tools/statistics/distributions.hpp"
#include "clients/tools/statistics/summary.hpp"

namespace dripline::statistics {
namespace {

Result<void> check(const GaugeStudy& study) {
  if (study.appraisers < 2 || study.parts < 2 || study.trials < 2) {
    return fail(Errc::LimitExceeded,
                "a gauge study of {} appraisers, {} parts and {} trials: 2 of each are needed",
                study.appraisers, study.parts, study.trials);
  }
  if (study.values.size() == study.appraisers * study.parts * study.trials) return {};
  return fail(Errc::LimitExceeded, "a gauge study with {} values, {} expected", study.values.size(),
              study.appraisers * study.parts * study.trials);
}

/// Position of `name` among the names in order of appearance.
std::size_t index_of(std::vector<std::string_view>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

template <class Take>
Summary over(const GaugeStudy& study, Take take) {
  RunningSummary running;
  for (std::size_t a = 0; a < study.appraisers; ++a)
    for (std::size_t p = 0; p < study.parts; ++p)
      for (std::size_t t = 0; t < study.trials; ++t)
        if (take(a, p)) running.add(study.at(a, p, t));
  return running.summary();
}
double mean_of_appraiser(const GaugeStudy& study, std::size_t appraiser) {
  return over(study, [&](std::size_t a, std::size_t) { return a == appraiser; }).mean;
}
double mean_of_part(const GaugeStudy& study, std::size_t part) {
  return over(study, [&](std::size_t, std::size_t p) { return p == part; }).mean;
}
Summary cell(const GaugeStudy& study, std::size_t appraiser, std::size_t part) {
  const std::size_t first = (appraiser * study.parts + part) * study.trials;
  return summarize(std::span(study.values).subspan(first, study.trials));
}

/// From the variances of the four sources.
GaugeResult assemble(double repeatability, double reproducibility, double parts,
                     std::optional<double> tolerance) {
  const double gauge = repeatability + reproducibility;
  const double total = gauge + parts;
  const auto component = [total](double variance) {
    return Component{std::sqrt(variance), 100 * std::sqrt(variance / total),
                     100 * variance / total};
  };
  GaugeResult result;
  result.repeatability = component(repeatability);
  result.reproducibility = component(reproducibility);
  result.gauge = component(gauge);
  result.parts = component(parts);
  result.total = std::sqrt(total);
  // A gauge without variation distinguishes any number of parts; 1000 is enough for a whole number.
  const double categories = gauge > 0 ? 1.41 * std::sqrt(parts / gauge) : 1000;
  result.distinct_categories = static_cast<int>(std::min(categories, 1000.0));
  if (tolerance && *tolerance > 0) {
    result.tolerance_percent = 100 * 6 * result.gauge.deviation / *tolerance;
  }
  return result;
}

VarianceTable variance_table(const GaugeStudy& study) {
  const auto a = static_cast<double>(study.appraisers), p = static_cast<double>(study.parts);
  const auto t = static_cast<double>(study.trials);
  const double mean = summarize(study.values).mean;
  std::vector<double> of_part(study.parts);
  for (std::size_t part = 0; part < study.parts; ++part) of_part[part] = mean_of_part(study, part);
  CompensatedSum appraisers, parts, interaction, within, total;
  for (std::size_t i = 0; i < study.appraisers; ++i) {
    const double of_appraiser = mean_of_appraiser(study, i);
    appraisers.add(p * t * (of_appraiser - mean) * (of_appraiser - mean));
    for (std::size_t j = 0; j < study.parts; ++j) {
      const double of_cell = cell(study, i, j).mean;
      const double rest = of_cell - of_appraiser - of_part[j] + mean;
      interaction.add(t * rest * rest);
      for (std::size_t k = 0; k < study.trials; ++k) {
        const double value = study.at(i, j, k);
        within.add((value - of_cell) * (value - of_cell));
        total.add((value - mean) * (value - mean));
      }
    }
  }
  for (const double of : of_part) parts.add(a * t * (of - mean) * (of - mean));
  const auto row = [](const CompensatedSum& squares, double degrees) {
    return VarianceRow{squares.value(), degrees, squares.value() / degrees, {}, {}};
  };
  return {row(appraisers, a - 1), row(parts, p - 1), row(interaction, (a - 1) * (p - 1)),
          row(within, a * p * (t - 1)), row(total, a * p * t - 1)};
}

void compare(VarianceRow& row, const VarianceRow& with) {
  if (!(with.mean_square > 0)) return;
  row.f = row.mean_square / with.mean_square;
  row.p_value = f_upper_tail(*row.f, row.degrees, with.degrees);
}

}  // namespace

Result<GaugeStudy> make_gauge_study(std::span<const GaugeReading> readings) {
  std::vector<std::string_view> appraisers, parts;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> cells;
  for (const auto& reading : readings) {
    if (!(std::abs(reading.value) <= kMaxMagnitude)) {
      return fail(Errc::LimitExceeded, "appraiser {} part {}: the value {:g}, at most {:g}",
                  reading.appraiser, reading.part, reading.value, kMaxMagnitude);
    }
    cells[{index_of(appraisers, reading.appraiser), index_of(parts, reading.part)}].push_back(
        reading.value);
  }
  GaugeStudy study{appraisers.size(), parts.size(), 0, {}};
  for (std::size_t a = 0; a < appraisers.size(); ++a) {
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto& trials = cells[{a, p}];
      if (study.values.empty()) study.trials = trials.size();
      if (trials.size() != study.trials) {
        return fail(Errc::Conflict, "appraiser {} part {}: {} trials, the first has {}",
                    appraisers[a], parts[p], trials.size(), study.trials);
      }
      study.values.insert(study.values.end(), trials.begin(), trials.end());
    }
  }
  if (auto good = check(study); !good) return fail(good.error());
  return study;
}

Result<GaugeResult> average_and_range(const RangeSummary& summary,
                                      std::optional<double> tolerance) {
  const auto k1 = gauge_factor(GaugeFactor::Trials, summary.trials);
  const auto k2 = gauge_factor(GaugeFactor::Appraisers, summary.appraisers);
  const auto k3 = gauge_factor(GaugeFactor::Parts, summary.parts);
  for (const auto* factor : {&k1, &k2, &k3}) {
    if (!*factor) return fail(factor->error());
  }
  const double repeatability = summary.mean_range * *k1;
  const double between = summary.appraiser_difference * *k2;
  const double part = summary.part_range * *k3;
  const double share =
      repeatability * repeatability / static_cast<double>(summary.parts * summary.trials);
  if (repeatability + between + part <= 0)
    return fail(Errc::Unsupported, "the values of the gauge study do not vary");
  return assemble(repeatability * repeatability, std::max(0.0, between * between - share),
                  part * part, tolerance);
}

Result<GaugeResult> average_and_range(const GaugeStudy& study, std::optional<double> tolerance) {
  if (auto good = check(study); !good) return fail(good.error());
  RunningSummary ranges, of_appraisers, of_parts;
  for (std::size_t a = 0; a < study.appraisers; ++a) {
    of_appraisers.add(mean_of_appraiser(study, a));
    for (std::size_t p = 0; p < study.parts; ++p) ranges.add(cell(study, a, p).range());
  }
  for (std::size_t p = 0; p < study.parts; ++p) of_parts.add(mean_of_part(study, p));
  return average_and_range({.appraisers = study.appraisers,
                            .parts = study.parts,
                            .trials = study.trials,
                            .mean_range = ranges.summary().mean,
                            .appraiser_difference = of_appraisers.summary().range(),
                            .part_range = of_parts.summary().range()},
                           tolerance);
}

Result<GaugeResult> gauge_anova(const GaugeStudy& study, std::optional<double> tolerance,
                                double alpha) {
  if (auto good = check(study); !good) return fail(good.error());
  const auto a = static_cast<double>(study.appraisers), p = static_cast<double>(study.parts);
  const auto t = static_cast<double>(study.trials);
  VarianceTable table = variance_table(study);
  if (!(table.total.squares > 0))
    return fail(Errc::Unsupported, "the values of the gauge study do not vary");
  compare(table.interaction, table.repeatability);
  const bool is_kept = table.interaction.p_value.value_or(0) <= alpha;
  VarianceRow error = table.repeatability;
  if (!is_kept) {
    error.squares += table.interaction.squares;
    error.degrees += table.interaction.degrees;
    error.mean_square = error.squares / error.degrees;
  }
  const VarianceRow& against = is_kept ? table.interaction : error;
  compare(table.appraisers, against);
  compare(table.parts, against);
  const auto variance = [&](const VarianceRow& row, double repeats) {
    return std::max(0.0, (row.mean_square - against.mean_square) / repeats);
  };
  const double interaction =
      is_kept ? std::max(0.0, (table.interaction.mean_square - error.mean_square) / t) : 0;
  GaugeResult result = assemble(error.mean_square, variance(table.appraisers, p * t) + interaction,
                                variance(table.parts, a * t), tolerance);
  result.table = table;
  result.is_interaction_kept = is_kept;
  return result;
}

}  // namespace dripline::statistics
