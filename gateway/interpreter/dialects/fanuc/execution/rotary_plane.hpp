#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// G12.1, G13.1 and G07.1: the modes in which a rotary axis makes a flat path.
namespace dripline::interpreter::fanuc {

/// Polar coordinate interpolation, on or off.
bool set_polar_plane(Run& run);
/// Cylindrical interpolation: G07.1 C50. on the radius 50, G07.1 C0 off.
bool set_cylinder(Run& run);
/// Whether the block does nothing that the mode in force excludes.
bool check_rotary_block(Run& run);
/// The end of the block's move in the mode: its rotary word is a length.
bool read_rotary_target(Run& run, Position& to);
/// Whether the last stage could make the moves, here and of G68.2 and G43.4.
bool check_last_stage(Run& run);

}  // namespace dripline::interpreter::fanuc
