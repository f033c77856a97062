#include "clients/tools/studies/capability_study.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace dripline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json index_json(const std::optional<statistics::Index>& index) {
  if (!index) return nullptr;
  ordered_json json{{"value", index->value}, {"low", nullptr}, {"high", nullptr}};
  if (index->interval) {
    json["low"] = index->interval->low;
    json["high"] = index->interval->high;
  }
  return json;
}

ordered_json number_json(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json(nullptr);
}

}  // namespace

Result<CapabilityStudy> study_capability(std::span<const measurement::Measurement> all,
                                         const CapabilityRequest& request) {
  if (all.empty()) return fail(Errc::NotFound, "nothing was measured");
  std::vector<double> values;
  values.reserve(all.size());
  for (const auto& one : all) {
    if (one.characteristic.name != all.front().characteristic.name) {
      return fail(Errc::Conflict, "capability of {} and {}: choose one characteristic",
                  all.front().characteristic.name, one.characteristic.name);
    }
    if (one.characteristic.unit != all.front().characteristic.unit) {
      return fail(Errc::Conflict, "capability of values in {} and in {}: choose those of one unit",
                  all.front().characteristic.unit, one.characteristic.unit);
    }
    values.push_back(one.actual);
  }
  if (!request.lower || !request.upper) {
    const auto which = request.lower   ? measurement::Limits::Upper
                       : request.upper ? measurement::Limits::Lower
                                       : measurement::Limits::All;
    if (auto one = measurement::check_one_tolerance(all, which); !one) {
      return fail(one.error().code, "{}, or give both limits", one.error().what);
    }
  }
  const auto& of = all.back().characteristic;
  CapabilityStudy study;
  study.unit = of.unit;
  study.tolerance = {request.lower ? request.lower : of.lower,
                     request.upper ? request.upper : of.upper};
  auto found = statistics::capability(values, study.tolerance, request.settings);
  if (!found) return fail(found.error());
  study.capability = *std::move(found);
  if (const auto test = statistics::anderson_darling(values)) study.normality = *test;
  return study;
}

ordered_json to_json(const CapabilityStudy& study) {
  const statistics::Capability& c = study.capability;
  ordered_json json{{"count", c.summary.count},
                    {"mean", c.summary.mean},
                    {"standard_deviation", c.summary.standard_deviation},
                    {"minimum", c.summary.minimum},
                    {"maximum", c.summary.maximum},
                    {"lower", number_json(study.tolerance.lower)},
                    {"upper", number_json(study.tolerance.upper)},
                    {"shape", statistics::to_string(c.shape)},
                    {"sigma_within", c.sigma_within},
                    {"within_by", c.within_by},
                    {"confidence", c.confidence},
                    {"cp", index_json(c.cp)},
                    {"cpk", index_json(c.cpk)},
                    {"pp", index_json(c.pp)},
                    {"ppk", index_json(c.ppk)},
                    {"below", c.below},
                    {"above", c.above},
                    {"expected_outside_ppm", c.expected_outside},
                    {"percentiles", {c.percentiles.low, c.percentiles.median, c.percentiles.high}},
                    {"percentiles_reached", c.is_percentile_reached},
                    {"anderson_darling", nullptr}};
  if (const auto& test = study.normality) {
    json["anderson_darling"] = {
        {"statistic", test->statistic}, {"adjusted", test->adjusted}, {"p_value", test->p_value}};
  }
  return json;
}

}  // namespace dripline::studies
