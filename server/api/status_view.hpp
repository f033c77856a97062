#pragma once

#include <nlohmann/json_fwd.hpp>

#include "protocol/dds/message.hpp"

namespace dripline::api {

/// What the API shows of a gateway's status: the members of protocol/dds/members.hpp under their
/// names, and `distance_to_go`. Axes are objects by letter, absent values null, times ISO 8601 UTC.
nlohmann::json status_json(const dds::Status& status);

}  // namespace dripline::api
