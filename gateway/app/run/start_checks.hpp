#pragma once

#include <optional>

#include "gateway/app/command_log.hpp"
#include "gateway/app/options.hpp"
#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// Why a start cannot be meant for this gateway, or is none: its control, name, digest or size.
std::optional<Reply> refusal_of_program(const dds::Command& start, const GatewayOptions& options);

/// A program that names no unit or another mode is read in those of the setup, and was perhaps
/// written for those in which the device itself reads it: both must be the same. Errors: Conflict,
/// Unsupported.
Result<void> check_reader(const std::optional<machine::ProgramReader>& reader,
                          const interpreter::Dialect& dialect, const interpreter::Setup& setup);

}  // namespace dripline::gateway
