#include "gateway/interpreter/dialects/tnc155/itnc/pocket_shape.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr double kQuarter = 90, kHalf = 180, kWhole = 360;

}  // namespace

PathPiece straight_piece(PlaneVector to) {
  PathPiece piece;
  piece.to = to;
  return piece;
}

PathPiece arc_piece(PlaneVector to, PlaneVector center, Turn turn, double sweep) {
  return {to, true, center, turn, sweep};
}

double sign_of_turn(Turn turn) {
  return turn == Turn::Counterclockwise ? 1 : -1;
}

PlaneVector PocketShape::begin() const {
  if (core == Core::Arc) return center + radius * unit_vector(angle);
  return center - half_length * unit_vector(angle);
}

PlaneVector PocketShape::end() const {
  if (core == Core::Arc) return center + radius * unit_vector(angle + span);
  return center + half_length * unit_vector(angle);
}

PlaneVector PocketShape::anchor() const {
  return is_rectangle ? center : end();
}

PlaneVector PocketShape::outward() const {
  if (core == Core::Arc) return left_of(unit_vector(angle + span));
  return is_rectangle ? left_of(unit_vector(angle)) : unit_vector(angle);
}

PathPiece PocketShape::along_core(bool to_end) const {
  const PlaneVector to = to_end ? end() : begin();
  if (core != Core::Arc) return straight_piece(to);
  return arc_piece(to, center, to_end ? Turn::Counterclockwise : Turn::Clockwise, span);
}

double PocketShape::core_length() const {
  if (core == Core::Arc) return radius * span * (Angle::kPi / kHalf);
  return 2 * half_length;
}

PathPiece PocketShape::approach(double away, Turn turn) const {
  const PlaneVector from = anchor(), out = outward();
  return arc_piece(from + away * out, from + (away / 2) * out, turn, kHalf);
}

PathPiece PocketShape::departure(double away, Turn turn) const {
  const PlaneVector to = anchor();
  return arc_piece(to, to + (away / 2) * outward(), turn, kHalf);
}

std::vector<PathPiece> PocketShape::ring(double away, Turn turn) const {
  if (is_rectangle) return rectangle(away, turn);
  if (core == Core::Arc) return around_arc(away, turn);
  if (core == Core::Line) return around_line(away, turn);
  return {arc_piece(center + away * outward(), center, turn, kWhole)};
}

/// From the middle of a long side. Corners are rounder with the distance, as those of every line
/// beside the outermost one.
std::vector<PathPiece> PocketShape::rectangle(double away, Turn turn) const {
  const PlaneVector across = outward();
  const PlaneVector along = -sign_of_turn(turn) * unit_vector(angle);  // of the travel at the begin
  const double round = std::clamp(corner - (room - away), 0.0, away);
  const double length = half_length + away;
  const auto at = [&](double a, double b) { return center + a * along + b * across; };
  std::vector<PathPiece> path;
  const auto add_corner = [&](double a, double b, bool ends_along) {
    const double inner_a = a - std::copysign(round, a), inner_b = b - std::copysign(round, b);
    path.push_back(straight_piece(ends_along ? at(a, inner_b) : at(inner_a, b)));
    if (round == 0) return;
    const PlaneVector to = ends_along ? at(inner_a, b) : at(a, inner_b);
    path.push_back(arc_piece(to, at(inner_a, inner_b), turn, kQuarter));
  };
  add_corner(length, away, false);
  add_corner(length, -away, true);
  add_corner(-length, -away, false);
  add_corner(-length, away, true);
  path.push_back(straight_piece(at(0, away)));
  return path;
}

std::vector<PathPiece> PocketShape::around_line(double away, Turn turn) const {
  const PlaneVector out = outward();
  const PlaneVector side = sign_of_turn(turn) * left_of(out);
  const PlaneVector from = begin(), to = end();
  return {arc_piece(to + away * side, to, turn, kQuarter), straight_piece(from + away * side),
          arc_piece(from - away * side, from, turn, kHalf), straight_piece(to - away * side),
          arc_piece(to + away * out, to, turn, kQuarter)};
}

/// The side that leads back to the begin comes first: counterclockwise it is the inner one.
std::vector<PathPiece> PocketShape::around_arc(double away, Turn turn) const {
  const PlaneVector from = begin(), to = end();
  const PlaneVector first = unit_vector(angle), last = unit_vector(angle + span);
  const double inward = -sign_of_turn(turn) * away;
  const PlaneVector out = outward();
  const auto beside = [&](PlaneVector ray, double by) { return center + (radius + by) * ray; };
  return {arc_piece(beside(last, inward), to, turn, kQuarter),
          arc_piece(beside(first, inward), center, Turn::Clockwise, span),
          arc_piece(beside(first, -inward), from, turn, kHalf),
          arc_piece(beside(last, -inward), center, Turn::Counterclockwise, span),
          arc_piece(to + away * out, to, turn, kQuarter)};
}

}  // namespace dripline::interpreter::tnc155::itnc
