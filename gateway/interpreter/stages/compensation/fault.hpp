#pragma once

#include <cstdint>
#include <string>

#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"

namespace dripline::interpreter::compensation {

/// Which rule a contour breaks. A dialect has its own number and wording for each.
enum class FaultKind : std::uint8_t {
  NoIntersection,      ///< two offset elements do not meet
  ArcTooSmall,         ///< an arc run on its inside with a radius under the cutter's
  Reversed,            ///< the compensated element would run against the programmed one
  ConcaveCorner,       ///< an inside corner, where the policy refuses them
  StartUpNotStraight,  ///< the first compensated move is an arc
  CancelNotStraight,   ///< the move that leaves compensation is an arc
  StartUpTooClose,     ///< the tool is within one radius of the end of a tangential start-up move
  OtherPlane,          ///< an arc in another plane than the compensated one
  ArcTooLarge,     ///< a start-up or cancel arc: the other end of its move lies within the circle
  RadiusAtArc,     ///< an arc that would begin with one radius and end with another
  FlatSideChange,  ///< the side changes, and the offset elements meet far from the corner
  TooMuchBetween,  ///< more events between two elements than kMaxHeldEvents or kMaxHeldText
};

/// Value and limit. ArcTooSmall: the radii of arc and cutter; StartUpTooClose: distance and radius.
using Fault = look_ahead::ContourFault<FaultKind>;

/// For a diagnostic: what is wrong, with value and limit in these units.
std::string describe(const Fault& fault, Units units);

}  // namespace dripline::interpreter::compensation
