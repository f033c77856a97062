#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Checks of words that depend on more than the text of the block: the values of Q parameters, and
/// the axes of this machine.

namespace dripline::interpreter::tnc155 {

/// A word of the block is a Q parameter or names another axis than X, Y and Z.
inline bool needs_check(const Block& block) {
  bool needs =
      block.radius.is_q() || block.angle.is_q() || block.length.is_q() || block.first.is_q();
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    needs |= block.coordinates[i].value.is_q() || block.coordinates[i].axis > Axis::Z;
  }
  return needs;
}

/// Q parameters must hold a value that is permitted as a number in their place, and axes must be
/// those of the machine. False: the run has failed.
bool check_words(Run& run, const Block& block);

/// X, Y, Z or axis IV.
bool check_axis(Run& run, Axis axis);

/// Whether a control of that version has every feature the block needs. False: `fault` names the
/// missing one, with the control's message where it has one. Only for versions that do not take all
/// blocks.
bool check_version(const ControlVersion& version, const Block& block, Fault& fault);
/// The same for the G codes of an ISO block, independent of the modal state.
bool check_version(const ControlVersion& version, const IsoBlock& block, Fault& fault);

}  // namespace dripline::interpreter::tnc155
