#pragma once

#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::api {

/// When the first certificate of a PEM file expires. Errors: Io (it cannot be read).
Result<UtcTime> certificate_expiry(const std::string& file);

}  // namespace dripline::api
