#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "clients/tools/statistics/capability.hpp"
#include "clients/tools/statistics/normality.hpp"
#include "protocol/measurement/measurement.hpp"

/// Studies of measurements. Pure; any thread.
namespace dripline::studies {

struct CapabilityRequest {
  std::optional<double> lower, upper;  ///< absent: that of the measurements, which is one
  statistics::CapabilitySettings settings;
};

/// The capability of the values, and whether they may be normal.
struct CapabilityStudy {
  statistics::Tolerance tolerance;  ///< that was applied
  std::string unit;
  statistics::Capability capability;
  std::optional<statistics::AndersonDarling> normality;  ///< absent: too few values
};

/// Oldest first. Errors: NotFound (none), Conflict (two characteristics, units, nominal values or
/// tolerances, unless both limits are given), those of
/// statistics::capability.
Result<CapabilityStudy> study_capability(std::span<const measurement::Measurement> all,
                                         const CapabilityRequest& request);
nlohmann::ordered_json to_json(const CapabilityStudy& study);

}  // namespace dripline::studies
