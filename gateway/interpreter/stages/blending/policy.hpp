#pragma once

#include <cstdint>
#include <string>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"

/// How the moves of a contour are blended: the rules of a control as data.

namespace dripline::interpreter::blending {

struct Policy {
  /// Every feed move waits for the next one, which may still shape their corner. Off:
  /// only a move whose end was announced as a corner or an estimate.
  bool every_move_waits = true;
  /// Rapid moves are elements as feed moves are. Off: a rapid move ends the wait.
  bool blends_rapids = false;
  /// A corner whose next element never comes is a fault. Off: it is left out.
  bool refuses_open_corner = false;
  /// A rounding between elements that go straight on or straight back is a fault. Off: there is no
  /// corner to round where they go straight on; straight back stays a fault.
  bool refuses_straight_corner = true;
};

/// The meaning of the size of a chamfer.
enum class Chamfer : std::uint8_t {
  Leg,   ///< the length it takes of each of the two lines
  Face,  ///< its own length
};

/// Which of two points a line that is solved back to an arc begins at.
enum class Back : std::uint8_t {
  Nearest,   ///< the nearer to its end: the short line
  Farthest,  ///< the long line
};

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
