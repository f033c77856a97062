#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::statistics {

/// Every appraiser measures every part several times.
struct GaugeStudy {
  std::size_t appraisers = 0, parts = 0, trials = 0;
  /// By appraiser, then part, then trial.
  std::vector<double> values;
  double at(std::size_t appraiser, std::size_t part, std::size_t trial) const {
    return values[(appraiser * parts + part) * trials + trial];
  }
};

struct GaugeReading {
  std::string_view appraiser, part;
  double value = 0;
};
/// From readings in any order; those of one appraiser and part are its trials in their order.
/// Errors: LimitExceeded (fewer than 2 appraisers, parts or trials; a value beyond kMaxMagnitude),
/// Conflict (a combination with other trials than the first).
Result<GaugeStudy> make_gauge_study(std::span<const GaugeReading> readings);

/// One source of variation: its standard deviation, and its part of all.
struct Component {
  double deviation = 0;
  double study_percent = 0;         ///< of the total's deviation
  double contribution_percent = 0;  ///< of the total's variance
};

struct VarianceRow {
  double squares = 0, degrees = 0, mean_square = 0;
  std::optional<double> f, p_value;
};
struct VarianceTable {
  VarianceRow appraisers, parts, interaction, repeatability, total;
};

struct GaugeResult {
  Component repeatability;      ///< equipment variation, EV
  Component reproducibility;    ///< appraiser variation, AV, with the interaction where it is kept
  Component gauge;              ///< GRR
  Component parts;              ///< PV
  double total = 0;             ///< deviation, TV
  int distinct_categories = 0;  ///< ndc: 1.41 PV / GRR, cut
  std::optional<double> tolerance_percent;  ///< 6 GRR of the tolerance
  std::optional<VarianceTable> table;       ///< ANOVA alone
  bool is_interaction_kept = false;         ///< ANOVA alone
};

/// What the average and range method is computed from.
struct RangeSummary {
  std::size_t appraisers = 0, parts = 0, trials = 0;
  double mean_range = 0;            ///< of the trials of a part by an appraiser, over all of them
  double appraiser_difference = 0;  ///< largest mean of an appraiser minus the smallest
  double part_range = 0;            ///< largest mean of a part minus the smallest
};
/// The last lines of the AIAG's form. Errors: LimitExceeded (a number of them for which there is no
/// factor), Unsupported (no variation).
Result<GaugeResult> average_and_range(const RangeSummary& summary, std::optional<double> tolerance);

/// Average and range method (AIAG, Measurement Systems Analysis, 4th edition, chapter III B).
/// `tolerance`: its full width. Errors: LimitExceeded (the study's shape).
Result<GaugeResult> average_and_range(const GaugeStudy& study, std::optional<double> tolerance);

/// Two-way analysis of variance with interaction, which is pooled with the repeatability where its
/// p-value is above `alpha`. Errors: as above; Unsupported (no variation).
Result<GaugeResult> gauge_anova(const GaugeStudy& study, std::optional<double> tolerance,
                                double alpha = 0.05);

}  // namespace dripline::statistics
