#include "gateway/interpreter/stages/blending/impl/element.hpp"

#include <cmath>

namespace dripline::interpreter::blending::impl {
namespace {

/// An arc that is a point may run backwards by this much, in radians.
constexpr double kNoTurn = 1e-9;
constexpr double kFullTurn = 2 * Angle::kPi;

PlaneVector direction(PlaneVector along) {
  const double size = length(along);
  return size > 0 ? (1 / size) * along : PlaneVector{1, 0};
}
PlaneVector tangent(const Element& arc, PlaneVector at) {
  return arc.side * left_of(direction(at - arc.center));
}

}  // namespace

double Element::radius_at(PlaneVector point) const {
  return announced.estimate ? announced.estimate->radius : length(point - center);
}

PlaneVector Element::direction_in() const {
  return is_arc ? tangent(*this, from) : direction(end - from);
}
PlaneVector Element::direction_out() const {
  return is_arc ? tangent(*this, end) : direction(end - from);
}

void Element::begin_at(PlaneVector point) {
  if (length(point - from) <= kNoLength) return;
  from = point;
  is_moved = true;
  if (is_arc) sweep = sweep_between(*this, from, end);
}
void Element::end_at(PlaneVector point) {
  if (length(point - end) <= kNoLength) return;
  end = point;
  is_moved = true;
  if (is_arc) sweep = sweep_between(*this, from, end);
}

double sweep_between(const Element& arc, PlaneVector from, PlaneVector end) {
  double sweep = arc.side * turn_between(from - arc.center, end - arc.center);
  if (sweep < -kNoTurn) sweep += kFullTurn;
  return sweep < 0 ? 0 : sweep;
}

}  // namespace dripline::interpreter::blending::impl
