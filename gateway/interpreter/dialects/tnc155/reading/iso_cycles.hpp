#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

/// Adds the sub-blocks of the cycle that an ISO block defines. `incremental` has the bits of the
/// incremental slots. False: `fault` has the reason.
bool add_cycle(const IsoBlock& block, unsigned incremental, Units units, BlockParts& parts,
               Fault& fault);

/// The slots that a cycle consumes, so that they do not cause a move.
unsigned slots_of_cycle(int code);

/// The cycle and the direction of a G code of the group Cycle, and back.
struct CycleCode {
  std::uint8_t cycle = 0;
  std::optional<Turn> turn;
};
CycleCode cycle_of_code(int code);
int code_of_cycle(int cycle, std::optional<Turn> turn);

}  // namespace dripline::interpreter::tnc155
