#pragma once

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

}  // namespace dripline::interpreter::tnc155
