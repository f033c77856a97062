#pragma once

#include <cstdint>
#include <string>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/stages/look_ahead/contour_fault.hpp"

namespace dripline::interpreter::blending {

/// Which rule a contour breaks. A dialect has its own number and wording for each.
enum class FaultKind : std::uint8_t {
  NoIntersection,  ///< a line that is solved back does not meet the element before it
  ArcsApart,       ///< two arcs with approximate ends do not meet
  OffArc,          ///< the end of an arc is off its circle, and nothing corrects it
  Straight,        ///< a rounding where the elements go straight on or straight back
  DoesNotFit,      ///< a rounding or chamfer takes more than there is of an element
  ChamferAtArc,    ///< a chamfer next to an arc
  OtherPlane,      ///< a corner with an arc of another plane
  NoElement,       ///< a corner or a back-solved line with no element before it
  OpenCorner,      ///< a corner with no element after it, where the policy refuses that
  TooMuchBetween,  ///< more events at a corner than wait (`look_ahead::kMaxHeldEvents`)
};

/// Value and limit. OffArc: the distance from the circle and its radius. DoesNotFit: the length
/// that the corner takes and that of the element (negative where no size would do).
using Fault = look_ahead::ContourFault<FaultKind>;

/// For a diagnostic: what is wrong, with value and limit in these units.
std::string describe(const Fault& fault, Units units = Units::Millimeter);

}  // namespace dripline::interpreter::blending
