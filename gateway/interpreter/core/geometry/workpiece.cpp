#include "gateway/interpreter/core/geometry/workpiece.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gateway/interpreter/core/geometry/plane_curves.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::interpreter {
namespace {

/// Millimeters: rounding of a position that went through inches and offsets stays far below it.
constexpr double kOnSurface = 1e-6;

constexpr PlaneAxes kTurning = axes_of(Plane::ZX);

/// The circle that an arc follows, in the plane ZX.
struct Circle {
  PlaneVector center, start;  ///< `start` from the center
  double sweep = 0;           ///< radians, counterclockwise positive

  PlaneVector at(double t) const {
    const double sine = std::sin(sweep * t), cosine = std::cos(sweep * t);
    return center + PlaneVector{start.first * cosine - start.second * sine,
                                start.first * sine + start.second * cosine};
  }
  /// Of the movement along the first axis there.
  double direction_of_first(double t) const { return -sweep * (at(t) - center).second; }
};

/// A move; t = 0 is its start and t = 1 its end.
struct Move {
  const Position& from;
  const Position& to;
  ProbeUntil until;
  double length;  ///< millimeters over X, Y, Z
  std::optional<Circle> circle;

  double start(Axis axis) const { return from.linear(axis).mm(); }
  double delta(Axis axis) const { return to.linear(axis).mm() - from.linear(axis).mm(); }
  double at(Axis axis, double t) const {
    if (circle && axis == kTurning.first) return circle->at(t).first;
    if (circle && axis == kTurning.second) return circle->at(t).second;
    return start(axis) + t * delta(axis);
  }
  /// The move's share that is as long as kOnSurface.
  double tolerance() const { return kOnSurface / length; }
};

/// `t` when it lies on the move, with the ends taken as exact.
std::optional<double> on_move(const Move& move, double t) {
  if (t < -move.tolerance() || t > 1 + move.tolerance()) return std::nullopt;
  return std::clamp(t, 0.0, 1.0);
}

/// Where an arc crosses a line of the plane ZX, in the order of the path.
std::vector<double> crossings(const Move& move, PlaneVector point, PlaneVector direction) {
  const Circle& circle = *move.circle;
  std::vector<double> places;
  const PlaneLine line =
      line_through(point - circle.center, (1 / interpreter::length(direction)) * direction);
  const auto met = interpreter::meet(line, PlaneCircle{{}, interpreter::length(circle.start)});
  if (!met) return places;
  const double sense = circle.sweep > 0 ? 1 : -1, all = std::fabs(circle.sweep);
  for (const PlaneVector& crossing : {met->one, met->other}) {
    double turn = sense * turn_between(circle.start, crossing);
    if (turn < 0) turn += 2 * Angle::kPi;
    for (const double angle : {turn, turn - 2 * Angle::kPi})
      if (const auto place = on_move(move, angle / all)) places.push_back(*place);
  }
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<double> crossings(const Move& move, Axis axis, double value) {
  if (axis == kTurning.first) return crossings(move, {value, 0}, {0, 1});
  return axis == kTurning.second ? crossings(move, {0, value}, {1, 0}) : std::vector<double>{};
}

std::optional<double> meet_on_arc(const ProbePlane& plane, const Move& move) {
  for (const double t : crossings(move, plane.axis, plane.at.mm())) {
    const bool leaves_material = move.circle->direction_of_first(t) > 0;
    const bool starts_on = t <= move.tolerance();
    const bool is_met =
        move.until == ProbeUntil::Release ? leaves_material : !(starts_on && leaves_material);
    if (plane.axis != Axis::Z || is_met) return t;
  }
  return std::nullopt;
}

std::optional<double> meet_on_arc(const ProbeCylinder& cylinder, const Move& move) {
  const double y = move.start(Axis::Y) - cylinder.center_y.mm();
  const double square = cylinder.radius.mm() * cylinder.radius.mm() - y * y;
  if (square < 0) return std::nullopt;
  std::optional<double> first;
  for (const double x : {-std::sqrt(square), std::sqrt(square)}) {
    const auto places = crossings(move, Axis::X, cylinder.center_x.mm() + x);
    if (!places.empty() && !(first && *first < places.front())) first = places.front();
  }
  return first;
}

bool starts_on(const ProbePlane& plane, const Move& move) {
  return std::fabs(plane.at.mm() - move.start(plane.axis)) <= kOnSurface;
}

std::optional<double> meet(const ProbePlane& plane, const Move& move) {
  if (move.circle) return meet_on_arc(plane, move);
  const double distance = plane.at.mm() - move.start(plane.axis);
  const double delta = move.delta(plane.axis);
  if (std::fabs(delta) < kOnSurface) return std::nullopt;  // along the plane
  if (plane.axis == Axis::Z) {
    const bool leaves_material = delta > 0;
    if (move.until == ProbeUntil::Contact && distance > kOnSurface) return 0.0;  // inside
    if (move.until == ProbeUntil::Contact && starts_on(plane, move) && leaves_material)
      return std::nullopt;
    if (move.until == ProbeUntil::Release && !leaves_material) return std::nullopt;
  }
  if (starts_on(plane, move)) return 0.0;
  return on_move(move, distance / delta);
}

std::optional<double> meet(const ProbeCylinder& cylinder, const Move& move) {
  if (move.circle) return meet_on_arc(cylinder, move);
  const double x = move.start(Axis::X) - cylinder.center_x.mm();
  const double y = move.start(Axis::Y) - cylinder.center_y.mm();
  const double dx = move.delta(Axis::X);
  const double dy = move.delta(Axis::Y);
  const double a = dx * dx + dy * dy;
  if (a < kOnSurface * kOnSurface) return std::nullopt;  // along the cylinder
  if (std::fabs(std::hypot(x, y) - cylinder.radius.mm()) <= kOnSurface) return 0.0;
  const double half_b = x * dx + y * dy;
  const double c = x * x + y * y - cylinder.radius.mm() * cylinder.radius.mm();
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  if (const auto first = on_move(move, (-half_b - root) / a)) return first;
  return on_move(move, (-half_b + root) / a);
}

/// Odd number of outline pieces above the point (toward +Z) = inside.
bool has_material(const ProbeProfile& profile, double x, double z) {
  bool inside = false;
  for (std::size_t i = 1; i < profile.points.size(); ++i) {
    const auto& a = profile.points[i - 1];
    const auto& b = profile.points[i];
    if ((a.x.mm() <= x) == (b.x.mm() <= x)) continue;  // half open: a corner is one crossing
    const double share = (x - a.x.mm()) / (b.x.mm() - a.x.mm());
    if (a.z.mm() + share * (b.z.mm() - a.z.mm()) > z) inside = !inside;
  }
  return inside;
}

/// Inside by more than the tolerance, so that a move along the outline is not inside.
bool is_inside(const ProbeProfile& profile, double x, double z) {
  return has_material(profile, x - kOnSurface, z + kOnSurface) &&
         has_material(profile, x + kOnSurface, z + kOnSurface);
}

/// `boundaries` of an arc.
std::vector<double> boundaries_on_arc(const ProbeProfile& profile, const Move& move) {
  std::vector<double> places{0.0, 1.0};
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const PlaneVector b{profile.points[i].z.mm(), profile.points[i].x.mm()};
    const auto at_corner = crossings(move, Axis::X, b.second);
    places.insert(places.end(), at_corner.begin(), at_corner.end());
    if (i == 0) continue;
    const PlaneVector a{profile.points[i - 1].z.mm(), profile.points[i - 1].x.mm()};
    const PlaneVector piece = b - a;
    if (piece == PlaneVector{}) continue;
    for (const double t : crossings(move, a, piece)) {
      const double along = dot(move.circle->at(t) - a, piece) / dot(piece, piece);
      if (along >= -1e-9 && along <= 1 + 1e-9) places.push_back(t);
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Where the move may go in or out: crossings of the outline, and the X of its corners, below which
/// the outline may begin or end.
std::vector<double> boundaries(const ProbeProfile& profile, const Move& move) {
  if (move.circle) return boundaries_on_arc(profile, move);
  const double dx = move.delta(Axis::X);
  const double dz = move.delta(Axis::Z);
  std::vector<double> places{0.0, 1.0};
  const auto add = [&](double t) {
    if (const auto place = on_move(move, t)) places.push_back(*place);
  };
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const auto& b = profile.points[i];
    if (dx != 0) add((b.x.mm() - move.start(Axis::X)) / dx);
    if (i == 0) continue;
    const auto& a = profile.points[i - 1];
    const double ex = b.x.mm() - a.x.mm();
    const double ez = b.z.mm() - a.z.mm();
    const double cross = dx * ez - dz * ex;
    if (cross == 0) continue;  // parallel: entered and left at corners
    const double ax = a.x.mm() - move.start(Axis::X);
    const double az = a.z.mm() - move.start(Axis::Z);
    const double along_piece = (ax * dz - az * dx) / cross;
    if (along_piece >= -1e-9 && along_piece <= 1 + 1e-9) add((ax * ez - az * ex) / cross);
  }
  std::sort(places.begin(), places.end());
  return places;
}

std::optional<double> meet(const ProbeProfile& profile, const Move& move) {
  const auto places = boundaries(profile, move);
  const auto inside_at = [&](double t) {
    return is_inside(profile, move.at(Axis::X, t), move.at(Axis::Z, t));
  };
  const bool wanted = move.until == ProbeUntil::Contact;
  bool was_inside = inside_at(0.0);
  if (wanted && was_inside) return 0.0;
  // A start on the outline belongs to the material, or a release from there would never be seen.
  if (!wanted && !was_inside) {
    was_inside = has_material(profile, move.start(Axis::X), move.start(Axis::Z) - 2 * kOnSurface);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    // Just after the last place the move is extended, so that a move that ends on the
    // outline has met it.
    const bool last = i + 1 == places.size();
    const double next = last ? 1.0 + 1e4 * move.tolerance() : places[i + 1];
    if (next - places[i] < 4 * move.tolerance()) continue;
    const bool inside = inside_at((places[i] + next) / 2);
    if (inside == wanted && inside != was_inside) return places[i];
    was_inside = inside;
  }
  return std::nullopt;
}

Position point_at(const Move& move, double t) {
  Position point = t >= 1.0 ? move.to : move.from;
  if (t > 0.0 && t < 1.0) {
    for (const Axis axis : kAllAxes) {
      const double start = move.from.raw(axis);
      const double end = move.to.raw(axis);
      if (start != end) point.set_raw(axis, start + t * (end - start));
    }
    if (move.circle) set_in_plane(point, kTurning, move.circle->at(t));
  }
  point.mark_all_of(move.to);
  return point;
}

void set_circle(const PathArc& arc, Move& move) {
  invariant(arc.plane == Plane::ZX, "a probe's arc lies in ZX");
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  const double sense = arc.turn == Turn::Counterclockwise ? 1 : -1;
  const PlaneVector start = in_plane(move.from, kTurning) - center;
  move.circle = Circle{center, start, sense * arc.sweep.radians()};
  move.length = interpreter::length(start) * arc.sweep.radians();
}

}  // namespace

ProbeResult Workpiece::probe(const Probe& probe) const {
  Move move{probe.from, probe.to, probe.until, 0, std::nullopt};
  move.length = std::hypot(move.delta(Axis::X), move.delta(Axis::Y), move.delta(Axis::Z));
  if (probe.arc) set_circle(*probe.arc, move);
  ProbeResult result{false, probe.to};
  if (move.length <= kOnSurface) return result;
  std::optional<double> first;
  const ProbePlane* plane = nullptr;
  for (const Surface& surface : surfaces_) {
    const auto place = std::visit([&](const auto& s) { return meet(s, move); }, surface);
    if (!place || (first && *first <= *place)) continue;
    first = place;
    plane = std::get_if<ProbePlane>(&surface);
  }
  if (!first) return result;
  result.tripped = true;
  result.at = point_at(move, *first);
  // Exact, whatever the rounding of t; not where the move begins inside.
  if (plane && (*first > 0 || starts_on(*plane, move))) result.at.set(plane->axis, plane->at);
  return result;
}

}  // namespace dripline::interpreter
