#pragma once

#include <optional>

#include "gateway/app/command_log.hpp"
#include "gateway/app/options.hpp"

namespace dripline::gateway {

/// Why a start cannot be meant for this gateway, or is none: its control, name, digest or size.
std::optional<Reply> refusal_of_program(const dds::Command& start, const GatewayOptions& options);

}  // namespace dripline::gateway
