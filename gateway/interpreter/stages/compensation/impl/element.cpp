#include "gateway/interpreter/stages/compensation/impl/element.hpp"

#include <algorithm>

namespace dripline::interpreter::compensation::impl {
namespace {

/// Along a circle, at a point `out` from its center, `radius` away.
PlaneVector tangent(PlaneVector out, double radius, double side) {
  return radius > 0 ? (side / radius) * left_of(out) : PlaneVector{1, 0};
}

/// The turn from `from` to `to` about `center`, both scaled by the same factor.
struct Shift {
  Shift(PlaneVector from, PlaneVector to, PlaneVector center)
      : sine(cross(from - center, to - center)), cosine(dot(from - center, to - center)) {}
  double sine, cosine;
};

/// Angles so small are their own tangents to the last digit.
constexpr double kSmallSlope = 1e-6;

/// So near to a half turn, or to none, in radians, both directions are the same.
constexpr double kHalfTurn = 1e-9;

double angle_of(double sine, double cosine) {
  if (cosine > 0 && std::fabs(sine) < kSmallSlope * cosine) return sine / cosine;
  return std::atan2(sine, cosine);
}

/// In radians. Two angles that are acute have a difference of less than half a turn.
double difference(const Shift& a, const Shift& b) {
  if (a.cosine > 0 && b.cosine > 0) {
    return angle_of(a.sine * b.cosine - a.cosine * b.sine, a.cosine * b.cosine + a.sine * b.sine);
  }
  return angle_of(a.sine, a.cosine) - angle_of(b.sine, b.cosine);
}

}  // namespace

/// What an arc has left in it is dropped: equal states have equal bytes.
void complete_line(Element& element) {
  element.arch = {};
  const PlaneVector along = element.end - element.from;
  const PlaneVector direction = (1 / length(along)) * along;
  element.direction_in = direction;
  element.direction_out = direction;
}

void complete_arc(Element& element, const Arc& arc) {
  Arch& arch = element.arch;
  arch.center = {arc.center_first.mm(), arc.center_second.mm()};
  arch.side = arc.turn == Turn::Counterclockwise ? 1 : -1;
  arch.sweep = arc.sweep.radians();
  const PlaneVector in = element.from - arch.center;
  const PlaneVector out = element.end - arch.center;
  arch.radius_in = length(in);
  arch.radius_out = length(out);
  element.direction_in = tangent(in, arch.radius_in, arch.side);
  element.direction_out = tangent(out, arch.radius_out, arch.side);
  element.is_arc = true;
}

void complete_corner(Element& element, PlaneVector corner, PlaneVector direction) {
  element.is_arc = true;
  element.rounds_corner = true;
  element.from = element.end = corner;
  element.direction_in = element.direction_out = direction;
  element.arch = {.center = corner, .side = element.offset > 0 ? -1.0 : 1.0};
}

bool turn_corner(Element& element, PlaneVector direction) {
  double sweep = element.arch.side * turn_between(element.direction_in, direction);
  // away from the compensated side, whatever rounding makes of a half circle
  if (sweep < kHalfTurn - Angle::kPi) sweep += 2 * Angle::kPi;
  if (sweep < -kHalfTurn) return false;
  element.arch.sweep = std::max(sweep, 0.0);
  element.direction_out = direction;
  return true;
}

double offset_sweep(const Element& element, PlaneVector end) {
  const Arch& arch = element.arch;
  const Shift late(element.from, element.begin, arch.center);
  const Shift beyond(element.end, end, arch.center);
  return arch.sweep + arch.side * difference(beyond, late);
}

}  // namespace dripline::interpreter::compensation::impl
