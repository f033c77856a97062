#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Where the arcs of APPR and DEP meet the contour, and where the contour leads.
namespace dripline::interpreter::tnc155::itnc {

/// The arc of the tool's center, tangential to the contour's element.
struct TangentArc {
  PlaneVector at;  ///< where it meets the contour
  PlaneVector center;
  double radius = 0;
  Turn turn = Turn::Counterclockwise;
  double sign() const { return turn == Turn::Counterclockwise ? 1 : -1; }
};

PlaneVector rotated(PlaneVector vector, double degrees);
/// `from` is the contour's point, `along` its direction there. R above 0: from the side of the
/// compensation; below 0: from the other.
TangentArc tangent_arc(Run& run, Compensation side, PlaneVector from, PlaneVector along);
/// Where the straight line from `point` (`is_before`), or to it, touches the circle.
PlaneVector tangent_point(const TangentArc& arc, PlaneVector point, bool is_before);
/// Degrees from one point of the arc to another, in its direction.
double sweep_between(const TangentArc& arc, PlaneVector from, PlaneVector to);
/// The direction in which the contour leaves `from`: of length 1; (0, 0) where it is not known.
PlaneVector begin_direction(Run& run, const Block& next, PlaneVector from);

}  // namespace dripline::interpreter::tnc155::itnc
