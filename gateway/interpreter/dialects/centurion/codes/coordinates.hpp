#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Zeroes and transformations. The machine never moves by them: the program's position follows.
/// (Manual: G50, G12, G52; mirror, scaling and rotation.)
namespace dripline::interpreter::centurion {

bool set_floating_zero(Run& run);
bool set_local_zero(Run& run);
bool set_mirror(Run& run);
bool set_scaling(Run& run);
bool set_rotation(Run& run);

bool clear_floating_zero(Run& run, const GRow& row);
bool end_mirror(Run& run, const GRow& row);
bool end_scaling(Run& run, const GRow& row);
bool end_rotation(Run& run, const GRow& row);

}  // namespace dripline::interpreter::centurion
