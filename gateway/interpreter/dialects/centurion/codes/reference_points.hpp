#pragma once

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

/// Moves to places of the machine, made without compensation and without mirror, scaling and
/// rotation (manual: G28 to G30; G45 to G48; G53).
namespace dripline::interpreter::centurion {

/// G53: the words are machine coordinates; on a straight line.
bool move_in_machine(Run& run);
/// G28, G30.
bool go_to_reference(Run& run);
/// G29.
bool return_from_reference(Run& run);
/// G45 to G48, one axis each.
bool retract(Run& run, const GRow& row);
/// X to the place where tools are changed (M6).
bool go_to_tool_change(Run& run);

}  // namespace dripline::interpreter::centurion
