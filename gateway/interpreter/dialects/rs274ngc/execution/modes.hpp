#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// The modal G codes that move nothing (8).
namespace dripline::interpreter::rs274ngc {

/// G93, G94, G95 and the F word.
bool apply_feed(Run& run);
/// Planes, units, compensation, lengths, systems, path, distance and retract modes, in the
/// control's order.
bool apply_modes(Run& run);

void change_units(Run& run, Units units);

}  // namespace dripline::interpreter::rs274ngc
