#include "clients/tools/studies/gauge_study_of.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace dripline::studies {

using nlohmann::ordered_json;
using statistics::GaugeResult;

Result<GaugeMethod> parse_gauge_method(std::string_view name) {
  if (name == "anova") return GaugeMethod::Anova;
  if (name == "ranges") return GaugeMethod::Ranges;
  return fail(Errc::Syntax, "method '{}' is none of anova, ranges", name);
}

Result<GaugeResult> study_gauge(std::span<const measurement::Measurement> all, GaugeMethod method,
                                std::optional<double> tolerance) {
  std::vector<statistics::GaugeReading> readings;
  readings.reserve(all.size());
  for (const auto& one : all)
    readings.push_back({one.machine, one.serial.empty() ? one.part : one.serial, one.actual});
  const auto made = statistics::make_gauge_study(readings);
  if (!made) return fail(made.error());
  return method == GaugeMethod::Anova ? statistics::gauge_anova(*made, tolerance)
                                      : statistics::average_and_range(*made, tolerance);
}

ordered_json to_json(const GaugeResult& result) {
  ordered_json json;
  const auto add = [&](const char* name, const statistics::Component& of) {
    json[name] = {{"deviation", of.deviation},
                  {"study_percent", of.study_percent},
                  {"contribution_percent", of.contribution_percent}};
  };
  add("repeatability", result.repeatability);
  add("reproducibility", result.reproducibility);
  add("gauge", result.gauge);
  add("parts", result.parts);
  json["total"] = result.total;
  json["distinct_categories"] = result.distinct_categories;
  json["tolerance_percent"] =
      result.tolerance_percent ? ordered_json(*result.tolerance_percent) : ordered_json(nullptr);
  json["interaction_kept"] = result.is_interaction_kept;
  return json;
}

}  // namespace dripline::studies
