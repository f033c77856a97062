#include "gateway/interpreter/core/geometry/workpiece.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dripline::interpreter {
namespace {

/// Millimeters: rounding of a position that went through inches and offsets stays far below it.
constexpr double kOnSurface = 1e-6;

/// A straight move; t = 0 is its start and t = 1 its end.
struct Move {
  const Position& from;
  const Position& to;
  ProbeUntil until;
  double length;  ///< millimeters over X, Y, Z

  double start(Axis axis) const { return from.linear(axis).mm(); }
  double delta(Axis axis) const { return to.linear(axis).mm() - from.linear(axis).mm(); }
  double at(Axis axis, double t) const { return start(axis) + t * delta(axis); }
  /// The move's share that is as long as kOnSurface.
  double tolerance() const { return kOnSurface / length; }
};

/// `t` when it lies on the move, with the ends taken as exact.
std::optional<double> on_move(const Move& move, double t) {
  if (t < -move.tolerance() || t > 1 + move.tolerance()) return std::nullopt;
  return std::clamp(t, 0.0, 1.0);
}

std::optional<double> meet(const ProbePlane& plane, const Move& move) {
  const double distance = plane.at.mm() - move.start(plane.axis);
  const double delta = move.delta(plane.axis);
  if (std::fabs(delta) < kOnSurface) return std::nullopt;  // along the plane
  if (plane.axis == Axis::Z) {
    const bool leaves_material = delta > 0;
    const bool starts_on = std::fabs(distance) <= kOnSurface;
    if (move.until == ProbeUntil::Contact && starts_on && leaves_material) return std::nullopt;
    if (move.until == ProbeUntil::Release && !leaves_material) return std::nullopt;
  }
  if (std::fabs(distance) <= kOnSurface) return 0.0;
  return on_move(move, distance / delta);
}

std::optional<double> meet(const ProbeCylinder& cylinder, const Move& move) {
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

/// Where the move may go in or out: crossings of the outline, and the X of its corners, below which
/// the outline may begin or end.
std::vector<double> boundaries(const ProbeProfile& profile, const Move& move) {
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
  }
  point.mark_all_of(move.to);
  return point;
}

}  // namespace

ProbeResult Workpiece::probe(const Position& from, const Position& to, ProbeUntil until) const {
  Move move{from, to, until, 0};
  move.length = std::hypot(move.delta(Axis::X), move.delta(Axis::Y), move.delta(Axis::Z));
  ProbeResult result{false, to};
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
  if (plane) result.at.set(plane->axis, plane->at);  // exact, whatever the rounding of t
  return result;
}

}  // namespace dripline::interpreter
