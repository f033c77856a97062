#pragma once

#include "gateway/interpreter/core/machine_data.hpp"
#include "gateway/machine/streamed/text_rules.hpp"

namespace dripline::machine::streamed {

/// Whether the device is the machine that the setup states. Errors: Conflict (the first difference,
/// with both values and the device's setting).
Result<void> check_machine(const interpreter::MachineData& stated, const TextRules& rules);

}  // namespace dripline::machine::streamed
