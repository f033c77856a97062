#include "gateway/interpreter/dialects/tnc155/itnc/approach_geometry.hpp"

#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

/// Where LP leads from `from`.
PlaneVector polar_end(Run& run, const Block& next, PlaneVector from) {
  const PlaneVector pole = pole_in_plane(run.state);
  const PlaneVector out = from - pole;
  double radius = length(out);
  double angle = std::atan2(out.second, out.first) * (180 / Angle::kPi);
  if (next.radius.is_programmed())
    radius = run.length(next.radius) + (next.is_radius_incremental ? radius : 0);
  if (next.angle.is_programmed())
    angle = run.number(next.angle) + (next.is_angle_incremental ? angle : 0);
  return pole + radius * unit_vector(angle);
}

PlaneVector line_end(Run& run, const Block& next, PlaneVector from) {
  const PlaneAxes axes = axes_of(run.state.plane);
  PlaneVector to = from;
  for (const Coordinate& word : next.words()) {
    const double value = run.coordinate(word.axis, word.value);
    if (word.axis == axes.first) to.first = value + (word.is_incremental ? from.first : 0);
    if (word.axis == axes.second) to.second = value + (word.is_incremental ? from.second : 0);
  }
  return to;
}

}  // namespace

PlaneVector rotated(PlaneVector vector, double degrees) {
  const PlaneVector along = unit_vector(degrees);
  return along.first * vector + along.second * left_of(vector);
}

TangentArc tangent_arc(Run& run, Compensation side, PlaneVector from, PlaneVector along) {
  const State& state = run.state;
  const double tool = state.tool.data.radius / state.transformation.factor(state.plane);
  const double radius = run.length(run.parts.itnc.arc_radius);
  const bool is_left = side == Compensation::Left;
  const PlaneVector normal = (is_left ? 1.0 : -1.0) * left_of(along);
  TangentArc arc;
  arc.at = from + tool * normal;
  arc.center = arc.at + radius * normal;
  arc.radius = std::fabs(radius);
  arc.turn = is_left == (radius > 0) ? Turn::Counterclockwise : Turn::Clockwise;
  return arc;
}

PlaneVector tangent_point(const TangentArc& arc, PlaneVector point, bool is_before) {
  const PlaneVector out = point - arc.center;
  const double ratio = std::fmin(1, arc.radius / length(out));
  const double angle = std::acos(ratio) * (180 / Angle::kPi);
  return arc.center + ratio * rotated(out, (is_before ? 1 : -1) * arc.sign() * angle);
}

double sweep_between(const TangentArc& arc, PlaneVector from, PlaneVector to) {
  constexpr double kFull = 360;
  constexpr double kNoAngle = 1e-7;
  const PlaneVector begin = from - arc.center;
  const PlaneVector end = to - arc.center;
  double sweep = arc.sign() * std::atan2(cross(begin, end), dot(begin, end)) * (180 / Angle::kPi);
  if (sweep < 0) sweep += kFull;
  return sweep > kFull - kNoAngle ? 0 : sweep;
}

PlaneVector begin_direction(Run& run, const Block& next, PlaneVector from) {
  const State& state = run.state;
  const bool is_arc = next.kind == BlockKind::Arc || next.kind == BlockKind::PolarArc;
  const bool is_polar_line = next.kind == BlockKind::PolarLine;
  if ((is_arc || is_polar_line) && !state.has_pole) return {};
  if (is_arc) {
    const PlaneVector out = from - pole_in_plane(state);
    const double radius = length(out);
    if (radius == 0) return {};
    const double sign = next.turn == Turn::Clockwise ? -1 : 1;
    return (sign / radius) * left_of(out);
  }
  if ((next.kind != BlockKind::Line && !is_polar_line) || next.m != Block::kNone) return {};
  const PlaneVector to = is_polar_line ? polar_end(run, next, from) : line_end(run, next, from);
  const PlaneVector path = to - from;
  const double distance = length(path);
  constexpr double kNoTravel = 1e-6;
  if (distance < kNoTravel) return {};
  return (1 / distance) * path;
}

}  // namespace dripline::interpreter::tnc155::itnc
