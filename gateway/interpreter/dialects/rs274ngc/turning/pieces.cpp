#include "gateway/interpreter/dialects/rs274ngc/turning/pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

Turn turn_of(const ContourPiece& piece) {
  return piece.is_counterclockwise ? Turn::Counterclockwise : Turn::Clockwise;
}

double sweep_in_radians(const ContourPiece& piece, PlaneVector to) {
  return sweep_of(piece.center, piece.from, to, turn_of(piece)) * (Angle::kPi / 180);
}

PlaneVector tangent_at(const ContourPiece& piece, PlaneVector at) {
  const PlaneVector left = left_of(at - piece.center);
  return piece.is_counterclockwise ? left : -left;
}

double radius_of(const ContourPiece& piece) {
  return length(piece.from - piece.center);
}

/// Where two lines without end meet.
bool meet_lines(const ContourPiece& a, const ContourPiece& b, PlaneVector& at) {
  const PlaneVector along = a.to - a.from, other = b.to - b.from;
  const double across = cross(along, other);
  constexpr double kParallel = 1e-9;
  if (std::fabs(across) <= kParallel * length(along) * length(other)) return false;
  at = a.from + (cross(b.from - a.from, other) / across) * along;
  return true;
}

/// The points of a circle on the line through `foot` in the direction `along` (of length 1), where
/// `foot` is next to the center.
bool meet_circle(PlaneVector foot, PlaneVector along, double square, double slack,
                 std::array<PlaneVector, 2>& at) {
  if (square < -slack) return false;
  const double half = std::sqrt(std::max(0.0, square));
  at = {foot + half * along, foot - half * along};
  return true;
}

bool meet_line_and_arc(const ContourPiece& line, const ContourPiece& arc, double slack,
                       std::array<PlaneVector, 2>& at) {
  const PlaneVector run = line.to - line.from;
  const PlaneVector along = (1 / length(run)) * run;
  const PlaneVector foot = line.from + dot(arc.center - line.from, along) * along;
  const PlaneVector off = foot - arc.center;
  const double radius =
      length(arc.to - arc.center);  // as programmed it may differ from the start's
  return meet_circle(foot, along, radius * radius - dot(off, off), slack * radius, at);
}

bool meet_arcs(const ContourPiece& a, const ContourPiece& b, double slack,
               std::array<PlaneVector, 2>& at) {
  const PlaneVector between = b.center - a.center;
  const double apart = length(between);
  if (apart <= slack) return false;
  const double radius = radius_of(a), other = radius_of(b);
  const double part = (apart * apart + radius * radius - other * other) / (2 * apart);
  const PlaneVector along = (1 / apart) * between;
  return meet_circle(a.center + part * along, left_of(along), radius * radius - part * part,
                     slack * radius, at);
}

}  // namespace

PlaneVector CutFrame::in(PlaneVector at) const {
  return is_facing ? PlaneVector{along_sign * at.second, depth_sign * at.first}
                   : PlaneVector{along_sign * at.first, depth_sign * at.second};
}

PlaneVector CutFrame::out(PlaneVector at) const {
  return is_facing ? PlaneVector{depth_sign * at.second, along_sign * at.first}
                   : PlaneVector{along_sign * at.first, depth_sign * at.second};
}

bool CutFrame::is_mirrored() const {
  return (along_sign * depth_sign < 0) != is_facing;
}

PlaneVector direction_at_start(const ContourPiece& piece) {
  return piece.is_arc ? tangent_at(piece, piece.from) : piece.to - piece.from;
}

PlaneVector direction_at_end(const ContourPiece& piece) {
  return piece.is_arc ? tangent_at(piece, piece.to) : piece.to - piece.from;
}

double size_of(const ContourPiece& piece) {
  const double chord = length(piece.to - piece.from);
  return piece.is_arc ? std::min(chord, radius_of(piece)) : chord;
}

bool runs_along(const ContourPiece& piece, const ContourLimits& limits) {
  const double advance = piece.to.first - piece.from.first;
  if (!piece.is_arc) return advance >= -limits.least;
  const double side = piece.is_counterclockwise ? -1 : 1;
  return advance >= limits.least &&
         side * (piece.from.second - piece.center.second) >= -limits.least &&
         side * (piece.to.second - piece.center.second) >= -limits.least;
}

double distance_to(const ContourPiece& piece, PlaneVector point) {
  const double to_ends = std::min(length(point - piece.from), length(point - piece.to));
  if (piece.is_arc) {
    if (length(point - piece.center) == 0) return radius_of(piece);
    const double sweep = sweep_in_radians(piece, piece.to);
    const bool is_beside = sweep_in_radians(piece, point) <= sweep;
    return is_beside ? std::fabs(length(point - piece.center) - radius_of(piece)) : to_ends;
  }
  const PlaneVector run = piece.to - piece.from;
  const double square = dot(run, run);
  const double part = square > 0 ? dot(point - piece.from, run) / square : 0;
  return part > 0 && part < 1 ? length(point - piece.from - part * run) : to_ends;
}

PlaneVector point_on(const ContourPiece& piece, double part) {
  if (!piece.is_arc) return piece.from + part * (piece.to - piece.from);
  const double side = piece.is_counterclockwise ? 1 : -1;
  const double angle = side * part * sweep_in_radians(piece, piece.to);
  const PlaneVector from = piece.from - piece.center;
  return piece.center + std::cos(angle) * from + std::sin(angle) * left_of(from);
}

void move_aside(ContourPiece& piece, double distance) {
  if (piece.is_arc) {
    const double radius = radius_of(piece);
    const double scale = (radius + (piece.is_counterclockwise ? -distance : distance)) / radius;
    piece.from = piece.center + scale * (piece.from - piece.center);
    piece.to = piece.center + scale * (piece.to - piece.center);
    return;
  }
  const PlaneVector run = piece.to - piece.from;
  const PlaneVector by = (distance / length(run)) * left_of(run);
  piece.from = piece.from + by;
  piece.to = piece.to + by;
}

bool meet(ContourPiece& piece, ContourPiece& next, const ContourLimits& limits) {
  if (length(piece.to - next.from) <= limits.same) return true;
  std::array<PlaneVector, 2> at{};
  bool is_met = false;
  if (!piece.is_arc && !next.is_arc) {
    is_met = meet_lines(piece, next, at[0]);
    at[1] = at[0];
  } else if (piece.is_arc && next.is_arc) {
    is_met = meet_arcs(piece, next, limits.least, at);
  } else {
    is_met = piece.is_arc ? meet_line_and_arc(next, piece, limits.least, at)
                          : meet_line_and_arc(piece, next, limits.least, at);
  }
  if (!is_met) return false;
  // Of arcs that touch as good as once LinuxCNC takes the point on the left, of two points of a
  // line that are equally near that further on: a wall that begins level with its fillet's center.
  const double to_first = length(at[0] - next.from);
  const bool is_first = to_first <= length(at[1] - next.from) + limits.same ||
                        (piece.is_arc && next.is_arc && to_first <= 10 * limits.gap);
  piece.to = next.from = is_first ? at[0] : at[1];
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
