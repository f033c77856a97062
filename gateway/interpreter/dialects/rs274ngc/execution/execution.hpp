#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// A line that has been read and checked is done in the control's order (NIST 3.8, table 8).
namespace dripline::interpreter::rs274ngc {

/// Continues from `Block::stage`: an answer resumes where its question was asked.
bool execute_line(Run& run);

void apply_settings(Run& run);

// The modal G codes that move nothing; modes.cpp.

/// G93, G94, G95 and the F word.
bool apply_feed(Run& run);
/// Planes, units, compensation, lengths, systems, path, distance and retract modes, in the
/// control's order.
bool apply_modes(Run& run);

void change_units(Run& run, Units units);

}  // namespace dripline::interpreter::rs274ngc
