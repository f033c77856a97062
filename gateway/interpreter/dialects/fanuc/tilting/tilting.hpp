#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Tilted working planes and tool center point control: G68.2, G53.1, G69 and G43.4,
/// G43.5, G49.
namespace dripline::interpreter::fanuc {

/// Whether the machine needs kinematics for the code.
constexpr bool needs_kinematics(std::uint8_t code) {
  return code == kTiltedPlane || code == kAxisDirection || is_tip_control(code);
}

/// Whether the block does nothing that the mode in force excludes.
bool check_tilted_block(Run& run);
/// G68.2, and G69 while it is in force.
bool begin_tilted_plane(Run& run);
bool end_tilted_plane(Run& run);
/// G43.4 and G43.5, and G49 while one is in force.
bool begin_tip_control(Run& run);
bool end_tip_control(Run& run);
/// G43, G44, H and G49 in a tilted plane.
bool follow_length_offset(Run& run);
/// At the end of the block: a length that no move of it has taken moves the axes of a head.
bool take_length_offset(Run& run);
/// I, J, K in G43.5: the rotary axes of the move's end bring the tool along them. False: an alarm.
bool aim_tool(Run& run, Position& to);
/// G53.1.
bool direct_tool_axis(Run& run);

}  // namespace dripline::interpreter::fanuc
