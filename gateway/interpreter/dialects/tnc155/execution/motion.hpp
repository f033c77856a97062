#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Positioning blocks, with their feed; M functions of the block are execution.cpp's, except
/// those that say how it moves.
namespace dripline::interpreter::tnc155 {

bool run_line(Run& run, const Block& block);
bool run_polar_line(Run& run, const Block& block);
bool run_arc(Run& run, const Block& block);
bool run_polar_arc(Run& run, const Block& block);
bool run_tangent_arc(Run& run, const Block& block);
bool run_single_axis(Run& run, const Block& block);
/// CC: no motion.
bool set_pole(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155
