#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// Does one block (one part of an ISO block). False: see Run::pause.
bool execute(Run& run, const Block& block);

// Q parameters; q_parameters.cpp.

/// FN 0 to FN 8: sets a Q parameter. False after an alarm; the parameter keeps its value then.
bool compute(Run& run, const Block& block);
/// FN 9 to FN 12: whether the condition holds.
bool is_true(Run& run, const Block& block);

// Positioning blocks, with their feed (motion.cpp); M functions of the block are execution.cpp's,
// except those that state how it moves.

/// G90 and G91 in one block, in another order than the control sorts its words.
void warn_of_distance(Run& run);

bool run_line(Run& run, const Block& block);
bool run_polar_line(Run& run, const Block& block);
bool run_arc(Run& run, const Block& block);
bool run_polar_arc(Run& run, const Block& block);
bool run_tangent_arc(Run& run, const Block& block);
bool run_radius_arc(Run& run, const Block& block);  ///< CR
bool run_single_axis(Run& run, const Block& block);
/// CC: no motion.
bool set_pole(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155
