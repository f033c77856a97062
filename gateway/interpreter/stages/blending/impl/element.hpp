#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_curves.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"

/// Raw doubles inside this folder: millimeters and radians in the plane of the elements.
namespace dripline::interpreter::blending::impl {

/// Moves shorter than a tenth of a nanometer are none: their direction would be rounding noise.
inline constexpr double kNoLength = 1e-7;

/// The shape of the corner at the end of an element.
struct CornerShape {
  enum class Kind : std::uint8_t { Round, ChamferLeg, ChamferFace };
  Kind kind = Kind::Round;
  double size = 0;
  /// By a block of its own, whose place the inserted piece takes (`CornerPlace`).
  bool has_own_block = false;
  std::optional<Feed> feed;  ///< else that of the element
};

/// Both ends of a move are approximate: where it meets others of this kind is computed.
struct Estimate {
  double tolerance = 0;  ///< a point this near to a circle is on it
  double radius = 0;     ///< of an arc
};

/// A line that begins where it meets the element before it, along this slope.
struct LeadBack {
  PlaneVector direction;
  Back which = Back::Nearest;
};

/// The words about the next move that come before it.
struct Announced {
  std::optional<CornerShape> corner;
  std::optional<Estimate> estimate;
  std::optional<LeadBack> back;
};

struct Element {
  bool is_rapid = false;
  bool is_arc = false;
  bool is_moved = false;  ///< an end is not the programmed one
  /// As programmed; the members that an arc and a rapid move have, too.
  Line line;
  PlaneVector from, end;  ///< as programmed until its corners are decided
  PlaneVector center;     ///< of an arc
  double side = 1;        ///< +1: to the left, -1: to the right
  double sweep = 0;       ///< radians, > 0
  Angle given_sweep;      ///< as programmed, exactly
  Announced announced;

  /// The radius of an arc's circle near `point`.
  double radius_at(PlaneVector point) const;
  PlaneCircle circle_at(PlaneVector point) const { return {center, radius_at(point)}; }
  /// Directions of length 1 at start and end.
  PlaneVector direction_in() const;
  PlaneVector direction_out() const;
  /// It is a line. What an arc has left in it is dropped: equal states have equal bytes.
  void make_line() {
    is_arc = false;
    center = {};
    side = 1;
    sweep = 0;
    given_sweep = {};
  }
  /// Moves an end. The sweep follows.
  void begin_at(PlaneVector point);
  void end_at(PlaneVector point);
};

/// From `from` to `end` in the direction of `arc`, in [0, 2 pi); full circles are left out.
double sweep_between(const Element& arc, PlaneVector from, PlaneVector end);

}  // namespace dripline::interpreter::blending::impl
