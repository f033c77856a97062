#pragma once

#include <string_view>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

/// Moves to places of the machine, made without compensation and without mirror, scaling and
/// rotation (manual: G28 to G30; G45 to G48; G53).
namespace dripline::interpreter::centurion {

/// False, error 518: mirror or rotation is on, and whether they apply to the axis words of `what`
/// is not known (manual: scaling exempts G28 to G30 and G50, the others say nothing).
bool check_untransformed(Run& run, std::string_view what);
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
