#pragma once

#include <cstdint>

#include "protocol/base/result.hpp"

namespace dripline::process {

/// What the two daemons need at least, connections of clients not counted: below, DDS cannot be
/// opened, and dies of it instead of saying so.
inline constexpr std::uint64_t kServerFiles = 192, kGatewayFiles = 96;

/// Raises this process's limit of open files to `least` where that is allowed. Call before anything
/// is opened. Errors: LimitExceeded.
Result<void> require_open_files(std::uint64_t least);

}  // namespace dripline::process
