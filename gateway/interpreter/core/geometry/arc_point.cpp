#include "gateway/interpreter/core/geometry/arc_point.hpp"

#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter {

Position point_on_arc(const Arc& arc, const Position& from, double degrees) {
  const PlaneAxes axes = axes_of(arc.plane);
  const double turn = (arc.turn == Turn::Clockwise ? -degrees : degrees) * (Angle::kPi / 180.0);
  const double first = from.raw(axes.first) - arc.center_first.mm();
  const double second = from.raw(axes.second) - arc.center_second.mm();
  Position point = arc.to;
  point.set_raw(axes.first,
                arc.center_first.mm() + first * std::cos(turn) - second * std::sin(turn));
  point.set_raw(axes.second,
                arc.center_second.mm() + first * std::sin(turn) + second * std::cos(turn));
  const double part = arc.sweep.degrees() == 0 ? 1 : degrees / arc.sweep.degrees();
  const double height = from.raw(axes.normal);
  if (arc.to.raw(axes.normal) != height) {
    point.set_raw(axes.normal, height + part * (arc.to.raw(axes.normal) - height));
  }
  return point;
}

}  // namespace dripline::interpreter
