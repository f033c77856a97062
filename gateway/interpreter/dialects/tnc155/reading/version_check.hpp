#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

/// What a control of that version does not take, because it has not what the block asks for. False:
/// `fault` says it, in the control's words where it has some. Only for versions that do not take
/// all blocks.
bool check_version(const ControlVersion& version, const Block& block, Fault& fault);
/// The same of the G codes of an ISO block, whatever is in force where it stands.
bool check_version(const ControlVersion& version, const IsoBlock& block, Fault& fault);

}  // namespace dripline::interpreter::tnc155
