#pragma once

#include <nlohmann/json_fwd.hpp>

#include "protocol/measurement/measurement.hpp"

namespace dripline::measurement {

/// As the API answers it (Measurement of openapi.json) and as archives hold it.
nlohmann::json to_json(const Measurement& measurement);

}  // namespace dripline::measurement
