#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "clients/cli/text/table.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// What a gateway has rebuilt for a restart, the JSON of its record, as the operator reads it
/// before cycle start. Errors: Syntax (not such a record).
Result<Details> restart_details(const nlohmann::ordered_json& report);

}  // namespace dripline::cli
