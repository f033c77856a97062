#pragma once

#include <cstdint>
#include <string>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter::blending {

/// Which rule a contour breaks. A dialect has its own number and wording for each.
enum class FaultKind : std::uint8_t {
  NoIntersection,  ///< a line that is led back does not meet the element before it
  ArcsApart,       ///< two arcs whose join was estimated do not meet
  OffArc,          ///< the end of an arc is off its circle, and nothing corrects it
  Straight,        ///< a rounding where the elements go straight on or straight back
  DoesNotFit,      ///< a rounding or chamfer takes more than there is of an element
  ChamferAtArc,    ///< a chamfer next to an arc
  OtherPlane,      ///< a corner with an arc of another plane
  NoElement,       ///< a corner or a line that is led back, with no element before it
  OpenCorner,      ///< a corner with no element after it, where the policy refuses that
  TooMuchBetween,  ///< more events at a corner than wait (`look_ahead::kMaxHeldEvents`)
};

struct Fault {
  FaultKind kind = FaultKind::NoIntersection;
  Origin origin;  ///< the element that cannot be carried out
  Origin next;    ///< the element that showed it; the same one where no other took part
  /// OffArc: distance from the circle, its radius. DoesNotFit: what the corner takes, what there is
  /// (negative where no size would do).
  Length value, limit;
  bool first_is_arc = false, next_is_arc = false;
};

/// For a diagnostic: what is wrong, with value and limit in these units.
std::string describe(const Fault& fault, Units units = Units::Millimetre);

}  // namespace dripline::interpreter::blending
