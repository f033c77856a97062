#include "server/offsets/deviations.hpp"

#include <algorithm>
#include <map>

namespace dripline::offsets {
namespace {

using measurement::Measurement;

constexpr std::uint64_t kMeasurementsBack = 5'000;  ///< under other setups, or without a nominal
constexpr std::uint64_t kPageSize = 500;
constexpr double kMillimetersPerInch = 25.4;

/// Lengths in the setup's unit; anything else as it is.
double in_setup_unit(double value, const std::string& unit, const std::string& setup_unit) {
  if (unit == "mm" && setup_unit == "in") return value / kMillimetersPerInch;
  if (unit == "inch" && setup_unit == "mm") return value * kMillimetersPerInch;
  return value;
}

/// The runs of measurements, each asked for once.
class RunSetups {
 public:
  explicit RunSetups(storage::RunStore& runs) : runs_(runs) {}
  /// 0: the run had no setup. Nothing: there is no such run.
  std::optional<std::uint64_t> setup_of(const std::string& run) {
    const auto [found, is_new] = known_.try_emplace(run);
    if (is_new) {
      if (const auto stored = runs_.find(run)) found->second = stored->setup.value_or(0);
    }
    return found->second;
  }

 private:
  storage::RunStore& runs_;
  std::map<std::string, std::optional<std::uint64_t>> known_;
};

/// Whether a rule is for measurements. In doubt it is not.
class RuleScope {
 public:
  RuleScope(storage::MeasurementStore& stored, const OffsetRule& rule)
      : stored_(stored), rule_(rule) {}

  bool has(const Measurement& one) {
    if (!rule_.program.empty() && one.program != rule_.program) return false;
    if (!rule_.tool.empty() && bare_tool(one.tool) != bare_tool(rule_.tool)) return false;
    return rule_.template_name.empty() || template_of(one.part_id) == rule_.template_name;
  }

 private:
  const std::string& template_of(std::uint64_t part) {
    const auto [found, is_new] = templates_.try_emplace(part);
    if (is_new) {
      if (const auto stored = stored_.part(part)) found->second = stored->template_name;
    }
    return found->second;
  }

  storage::MeasurementStore& stored_;
  const OffsetRule& rule_;
  std::map<std::uint64_t, std::string> templates_;
};

}  // namespace

Result<Measured> find_deviations(const storage::Store& store, const DeviationQuery& query) {
  const OffsetRule& rule = query.rule;
  RunSetups runs(store.runs);
  RuleScope scope(store.measurements, rule);
  storage::MeasurementFilter filter;
  filter.machine = query.machine;
  filter.characteristic = rule.characteristic;
  Measured found;
  auto& deviations = found.deviations;
  std::optional<storage::MeasurementPlace> before;
  std::uint64_t seen = 0;
  while (deviations.size() < rule.window) {
    if (found.is_cut = seen >= kMeasurementsBack; found.is_cut) break;
    const auto rows = store.measurements.list_newest(filter, before, kPageSize);
    if (!rows) return fail(rows.error());
    for (const Measurement& m : *rows) {
      const auto off = measurement::deviation(m);
      const auto setup = m.run.empty() ? std::nullopt : runs.setup_of(m.run);
      if (!off || !setup || *setup < query.since || deviations.size() == rule.window) continue;
      if (scope.has(m)) {
        deviations.push_back({m.id, in_setup_unit(*off, m.characteristic.unit, query.unit)});
      } else {
        ++found.of_others;
      }
    }
    seen += rows->size();
    if (rows->size() < kPageSize) break;
    before = storage::MeasurementPlace{rows->back().time, rows->back().id};
  }
  std::ranges::reverse(deviations);
  return found;
}

}  // namespace dripline::offsets
