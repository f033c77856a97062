#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Tilted working planes (PLANE) and tool center point control (M128, FUNCTION TCPM), on
/// `stages/tilting`. In both `State::machine` is where the program has the tool, in coordinates as
/// if nothing were tilted; the stage knows the axes.
namespace dripline::interpreter::tnc155::itnc {

bool set_plane(Run& run, const Block& block);
/// The axes of the plane that the block's words give; `present`: those of the plane in force.
bool frame_of_plane(Run& run, const tilting::Matrix3& present, tilting::Matrix3& frame);
/// FUNCTION TCPM.
bool change_tip_control(Run& run, const Block& block);
/// M128, before the move; M129, after it.
bool begin_tip_control(Run& run);
bool end_tip_control(Run& run);

/// Whether a positioning block may be made as it is. `is_made`: it was made here.
bool check_tilted_move(Run& run, const Block& block, bool& is_made);
/// A cycle, a tool or a transformation, `what`, in the mode in force.
bool check_tilted_cycle(Run& run, std::string_view what);
bool check_tilted_tool(Run& run);
bool check_tilted_transformation(Run& run, const Block& block);
/// Only for a move that names linear axes in program coordinates.
bool check_shift_is_known(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155::itnc
