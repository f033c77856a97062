#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Zeroes and transformations: G12, G50, G52 (spec 8.3, 8.4), G511, G551, G568 and what ends them
/// (spec 19). The machine never moves by them: the program's position follows.
namespace dripline::interpreter::centurion {

/// What the axis words of a G50, G52, G511, G551 or G568 say; nothing for other blocks.
bool set_coordinates(Run& run);
void clear_floating_zero(Run& run);

void end_mirror(Run& run);
void end_scaling(Run& run);
void end_rotation(Run& run);

}  // namespace dripline::interpreter::centurion
