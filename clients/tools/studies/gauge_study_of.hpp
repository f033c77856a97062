#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "clients/tools/statistics/gauge_study.hpp"
#include "protocol/measurement/measurement.hpp"

namespace dripline::studies {

enum class GaugeMethod : std::uint8_t { Anova, Ranges };
/// anova, ranges. Errors: Syntax.
Result<GaugeMethod> parse_gauge_method(std::string_view name);

/// Machines are the appraisers; the parts are the serial numbers, or the part numbers where there
/// are none; what one machine measured of one part are its trials. `tolerance`: its full width.
/// Errors: those of make_gauge_study and of the method.
Result<statistics::GaugeResult> study_gauge(std::span<const measurement::Measurement> all,
                                            GaugeMethod method, std::optional<double> tolerance);
nlohmann::ordered_json to_json(const statistics::GaugeResult& result);

}  // namespace dripline::studies
