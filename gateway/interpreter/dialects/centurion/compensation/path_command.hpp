#pragma once

#include "gateway/interpreter/stages/blending/corner_blender.hpp"

namespace dripline::interpreter::centurion {

/// What a program says to the compensation stage besides its moves. The blending stage in front of
/// it, which holds moves back, holds these in their place among them.
struct PathCommand {
  enum class Kind : std::uint8_t {
    TurnOn,          ///< from the next move on, with `cutter`
    TurnOff,         ///< the next move is the cancel move
    Leave,           ///< off at once; the next move goes straight to its programmed end
    SuppressOutput,  ///< moves only say where the program is (G65)
    Go,              ///< moves are carried out again
  };
  Kind kind = Kind::TurnOn;
  compensation::Cutter cutter;
};

/// This control's rules for joins.
blending::Policy blending_policy();

void carry_out(blending::CornerBlender& front, const PathCommand& command);

}  // namespace dripline::interpreter::centurion
