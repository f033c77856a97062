#pragma once

#include <cstdint>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter::tnc155::itnc {

/// A straight piece, or an arc, of the path of a tool's center.
struct PathPiece {
  PlaneVector to;
  bool is_arc = false;
  PlaneVector center;
  Turn turn = Turn::Counterclockwise;
  double sweep = 0;  ///< degrees
};

PathPiece straight_piece(PlaneVector to);
PathPiece arc_piece(PlaneVector to, PlaneVector center, Turn turn, double sweep);
/// 1 counterclockwise, else -1.
double sign_of_turn(Turn turn);

/// Where the center of the tool may be in a pocket or a slot: within `room` of its core, which is a
/// point, a straight line or an arc; a rectangle has corners there in place of round ends. Pure;
/// program coordinates, millimeters and degrees.
struct PocketShape {
  enum class Core : std::uint8_t { Point, Line, Arc };

  Core core = Core::Point;
  bool is_rectangle = false;  ///< its core is a line
  PlaneVector center;         ///< of the core; of an arc's circle
  double angle = 0;           ///< of the line's direction; where the arc begins
  double half_length = 0;     ///< of the line
  double radius = 0;          ///< of the arc
  double span = 0;            ///< of the arc, counterclockwise
  double room = 0;            ///< to both sides
  double corner = 0;          ///< radius of a rectangle's corners, at `room`

  PlaneVector begin() const;
  PlaneVector end() const;
  /// Where the rings are entered and left: a point of the core, and the direction from there.
  PlaneVector anchor() const;
  PlaneVector outward() const;
  /// Along the core to its begin or end, from the other one.
  PathPiece along_core(bool to_end) const;
  double core_length() const;
  /// Once around at this distance from the core, from `anchor` + `away` * `outward` and back.
  std::vector<PathPiece> ring(double away, Turn turn) const;
  /// Half a circle between the anchor and the ring, tangential to it.
  PathPiece approach(double away, Turn turn) const;
  PathPiece departure(double away, Turn turn) const;

 private:
  std::vector<PathPiece> rectangle(double away, Turn turn) const;
  std::vector<PathPiece> around_line(double away, Turn turn) const;
  std::vector<PathPiece> around_arc(double away, Turn turn) const;
};

}  // namespace dripline::interpreter::tnc155::itnc
