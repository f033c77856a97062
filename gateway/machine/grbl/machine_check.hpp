#pragma once

#include "gateway/interpreter/core/machine_data.hpp"
#include "gateway/machine/grbl/board_info.hpp"

namespace dripline::machine::grbl {

/// Whether the board is the machine that the setup states. Errors: Conflict (the first difference,
/// with both values and the board's setting).
Result<void> check_machine(const interpreter::MachineData& stated, const BoardInfo& board);

}  // namespace dripline::machine::grbl
