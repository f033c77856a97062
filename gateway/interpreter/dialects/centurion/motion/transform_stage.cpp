#include "gateway/interpreter/dialects/centurion/motion/transform_stage.hpp"

#include <cmath>

#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

Point machine_of(const Run& run, const Point& programmed) {
  return machine_of(run.state, programmed);
}

Point machine_of(const ModalState& state, const Point& programmed) {
  if (!state.transformation.is_on()) return programmed;
  const Point& zero = state.origin;
  const Point moved = state.transformation.apply({programmed.x - zero.x, programmed.z - zero.z});
  return {zero.x + moved.x, zero.z + moved.z};
}

Point programmed_of(const Run& run, const Point& machine) {
  const ModalState& state = run.state;
  if (!state.transformation.is_on()) return machine;
  const Point& zero = state.origin;
  const Point back = state.transformation.undo({machine.x - zero.x, machine.z - zero.z});
  return {zero.x + back.x, zero.z + back.z};
}

Point TransformStage::point_of(Length z, Length x) const {
  const double mm = run_.state.mm_per_unit();
  return {x.mm() / mm, z.mm() / mm};
}

/// A rotated axis moves both axes of the machine.
Position TransformStage::moved(const Position& to) const {
  const bool rotates = run_.state.transformation.rotates;
  const Point at = machine_of(run_, point_of(to.linear(Axis::Z), to.linear(Axis::X)));
  Position moved = to;
  moved.set(Axis::X, run_.length(at.x));
  moved.set(Axis::Z, run_.length(at.z));
  if (!rotates && !to.has(Axis::X)) moved.unmark(Axis::X);
  if (!rotates && !to.has(Axis::Z)) moved.unmark(Axis::Z);
  return moved;
}

void TransformStage::on_rapid(const Rapid& event) {
  out().on_rapid({event.origin, moved(event.to), event.rests});
}

void TransformStage::on_line(const Line& event) {
  out().on_line({event.origin, moved(event.to), event.feed, event.rests});
}

/// Different factors would make an ellipse: the arc keeps a radius, scaled as Z is, and its ends.
bool TransformStage::place_center(Arc& arc, const Point& start, const Point& end) const {
  const Transformation& how = run_.state.transformation;
  const Point center = point_of(arc.center_first, arc.center_second);
  Point placed = machine_of(run_, center);
  const bool is_uneven = how.scales && std::fabs(how.factor.x) != std::fabs(how.factor.z);
  if (is_uneven && arc.sweep.degrees() < 360) {
    const double radius = distance(run_.state.position, center) * how.length_factor();
    const bool is_clockwise = arc.turn == Turn::Clockwise;
    const double tolerance = run_.state.units == Units::Inch ? 0.001 : 0.01;
    const double signed_radius = arc.sweep.degrees() > 180 ? -radius : radius;
    const auto fitted = center_of({start, end, signed_radius, is_clockwise}, tolerance);
    if (!fitted) return false;
    placed = *fitted;
    arc.sweep = Angle::degrees(sweep_of({start, end, placed, is_clockwise}));
  }
  arc.center_first = run_.length(placed.z);
  arc.center_second = run_.length(placed.x);
  return true;
}

bool TransformStage::transform(Arc& arc) const {
  if (!run_.state.transformation.is_on()) return true;
  const Point start = machine_of(run_, run_.state.position);
  const Point end = machine_of(run_, point_of(arc.to.linear(Axis::Z), arc.to.linear(Axis::X)));
  arc.to = moved(arc.to);
  if (run_.state.transformation.swaps_sides()) {
    arc.turn = arc.turn == Turn::Clockwise ? Turn::Counterclockwise : Turn::Clockwise;
  }
  return place_center(arc, start, end);
}

void TransformStage::on_arc(const Arc& event) {
  Arc arc = event;
  if (transform(arc)) {
    out().on_arc(arc);
  } else {
    misfit_ = event.origin;
  }
}

void TransformStage::on_thread(const Thread& event) {
  Thread thread = event;
  thread.to = moved(event.to);
  if (event.arc) {
    Arc arc = arc_of(event);
    if (!transform(arc)) {
      misfit_ = event.origin;
      return;
    }
    thread.arc = PathArc{arc.center_first, arc.center_second, arc.plane, arc.turn, arc.sweep};
  }
  out().on_thread(thread);
}

namespace {

Point rotated(const Point& point, const Point& center, double degrees) {
  const double sine = language::sine(degrees).value;
  const double cosine = language::cosine(degrees).value;
  const double z = point.z - center.z;
  const double x = point.x - center.x;
  return {center.x + z * sine + x * cosine, center.z + z * cosine - x * sine};
}

}  // namespace

bool Transformation::swaps_sides() const {
  bool swaps = mirrors_x != mirrors_z;
  if (scales && (factor.x < 0) != (factor.z < 0)) swaps = !swaps;
  return swaps;
}

double Transformation::length_factor() const {
  return scales ? std::fabs(factor.z) : 1;
}

Point Transformation::apply(Point point) const {
  if (mirrors_x) point.x = 2 * mirror.x - point.x;
  if (mirrors_z) point.z = 2 * mirror.z - point.z;
  if (scales) {
    point.x = scale_center.x + factor.x * (point.x - scale_center.x);
    point.z = scale_center.z + factor.z * (point.z - scale_center.z);
  }
  return rotates ? rotated(point, rotation_center, degrees) : point;
}

Point Transformation::undo(Point point) const {
  if (rotates) point = rotated(point, rotation_center, -degrees);
  if (scales) {
    point.x = scale_center.x + (point.x - scale_center.x) / factor.x;
    point.z = scale_center.z + (point.z - scale_center.z) / factor.z;
  }
  if (mirrors_x) point.x = 2 * mirror.x - point.x;
  if (mirrors_z) point.z = 2 * mirror.z - point.z;
  return point;
}

}  // namespace dripline::interpreter::centurion
