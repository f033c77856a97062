#include "gateway/interpreter/compensation/impl/element.hpp"

namespace dripline::interpreter::compensation::impl {
namespace {

PlaneVector direction(PlaneVector along) {
  return (1 / length(along)) * along;
}
/// Along a circle, at a point `out` from its centre.
PlaneVector tangent(PlaneVector out, double side) {
  return length(out) > 0 ? side * left_of(direction(out)) : PlaneVector{1, 0};
}

}  // namespace

void complete_line(Element& element) {
  element.direction_in = direction(element.end - element.from);
  element.direction_out = element.direction_in;
}

void complete_arc(Element& element, const Arc& arc) {
  Arch& arch = element.arch;
  arch.center = {arc.center_first.mm(), arc.center_second.mm()};
  arch.side = arc.turn == Turn::CounterClockwise ? 1 : -1;
  arch.sweep = arc.sweep.radians();
  const PlaneVector in = element.from - arch.center;
  const PlaneVector out = element.end - arch.center;
  arch.radius_in = length(in);
  arch.radius_out = length(out);
  element.direction_in = tangent(in, arch.side);
  element.direction_out = tangent(out, arch.side);
  element.is_arc = true;
}

double offset_sweep(const Element& element, PlaneVector end) {
  const Arch& arch = element.arch;
  const double late = turn_between(element.from - arch.center, element.begin - arch.center);
  const double beyond = turn_between(element.end - arch.center, end - arch.center);
  return arch.sweep + arch.side * (beyond - late);
}

}  // namespace dripline::interpreter::compensation::impl
