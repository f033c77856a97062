#pragma once

#include <optional>
#include <vector>

#include "clients/tools/graphics/turned_section.hpp"

namespace dripline::graphics {

/// A lathe tool as the controls' tables describe it: where its imaginary tip lies from the center
/// of its nose (types 1 to 4 the corners, 5 to 8 the sides, 0 and 9 none), and the nose's radius.
struct TurningTool {
  int type = 3;
  double radius = 0;
  /// Diameter of a drill (type 7 on the axis); width of a blade (5 to 8), from the tip
  /// toward +Z or +X.
  std::optional<double> width;
};

struct ToolUse {
  double insert_degrees = 55;  ///< angle between the edges of types 1 to 4
  double reach = 1000;         ///< of the shank: beyond the material, mm
  double least_radius = 0;     ///< of what is drawn, so that a sharp tool cuts cells too
  bool is_thread = false;      ///< cut with a pointed insert, whatever the type
  bool is_on_axis = false;
};

/// The area the tool removes with its imaginary tip at (0, 0): convex pieces.
std::vector<ConvexOutline> cutting_pieces(const TurningTool& tool, const ToolUse& use);

}  // namespace dripline::graphics
