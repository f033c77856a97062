#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

/// Whether a control of that version has every feature the block needs. False: `fault` names the
/// missing one, with the control's message where it has one. Only for versions that do not take all
/// blocks.
bool check_version(const ControlVersion& version, const Block& block, Fault& fault);
/// The same for the G codes of an ISO block, independent of the modal state.
bool check_version(const ControlVersion& version, const IsoBlock& block, Fault& fault);

}  // namespace dripline::interpreter::tnc155
