#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

/// Resolves the blocks whose words must be alone in their block: %, D functions, label calls.
/// Arguments and result as of `resolve`.
bool resolve_alone(const IsoBlock& block, bool is_first, ProgramForm& program, BlockParts& parts,
                   Fault& fault);

}  // namespace dripline::interpreter::tnc155
