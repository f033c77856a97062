#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/stages/compensation/policy.hpp"

/// Raw doubles inside this folder: millimeters and radians in the compensated plane. They
/// describe the path of the nose center; the vector to a lathe's tool tip is added when a move is
/// put out.
namespace dripline::interpreter::compensation::impl {

/// Moves shorter than a tenth of a nanometer are none: their direction would be rounding noise.
inline constexpr double kNoLength = 1e-7;

/// One inserted move of the path to an element's own compensated start.
struct Piece {
  bool is_arc = false;
  PlaneVector to;
  PlaneVector center;
  double sweep = 0;                   ///< of an arc: radians, positive to the left
  std::optional<Origin> origin = {};  ///< else the element's
};
struct LeadIn {
  std::uint8_t count = 0;
  std::array<Piece, 3> pieces{};
  void add(const Piece& piece) { pieces[count++] = piece; }
};

/// The effect of an element on compensation.
enum class Role : std::uint8_t { Contour, StartUp, Cancel, Parallel };

struct Arch {
  PlaneVector center;
  double radius_in = 0;   ///< from the center to the start; differs from the end's by rounding
  double radius_out = 0;  ///< from the center to the end
  double side = 1;        ///< +1: to the left, -1: to the right
  double sweep = 0;       ///< radians, > 0
};

/// A start-up or cancel move that meets the contour by an arc, which a block of its own asked for.
struct ByArc {
  double radius = 0;
  Origin origin;
};

/// A programmed move in the plane, and its compensated path as far as it is known.
struct Element {
  bool is_rapid = false;
  bool is_arc = false;
  bool rests = false;          ///< the axes come to rest at its end
  bool is_silent = false;      ///< decides its corners, but is not carried out
  bool rounds_corner = false;  ///< about the corner point, until the next element begins
  Role role = Role::Contour;
  StartUp start_up = StartUp::NextNormal;                 ///< of the role StartUp
  OutsideCorner outside = OutsideCorner::ExtendTangents;  ///< of the corner at its end
  Origin origin;
  Position to;  ///< as programmed
  Feed feed;
  PlaneVector from, end;                    ///< as programmed
  PlaneVector direction_in, direction_out;  ///< of length 1, at start and end
  Arch arch;                                ///< of an arc
  std::optional<ByArc> by_arc;              ///< of the roles StartUp and Cancel
  double offset = 0;                        ///< to the left of the direction
  PlaneVector begin;                        ///< where the compensated element starts
  LeadIn lead_in;                           ///< how the tool gets there

  PlaneVector normal_in() const { return left_of(direction_in); }
  PlaneVector normal_out() const { return left_of(direction_out); }
  PlaneVector own_begin() const { return from + offset * normal_in(); }
  PlaneVector own_end() const { return end + offset * normal_out(); }
  /// Of the offset arc; the smaller one is below 0 where the cutter does not fit inside.
  double offset_radius_in() const { return arch.radius_in - arch.side * offset; }
  double offset_radius_out() const { return arch.radius_out - arch.side * offset; }
};

/// Sets the directions of a straight element from `from` and `end`, which are kNoLength apart.
void complete_line(Element& element);
/// Sets directions, radii and turn of an arc from `from`, `end`, its center and its turn.
void complete_arc(Element& element, const Arc& arc);
/// An arc of no radius about `corner`, which arrives and leaves along `direction`.
void complete_corner(Element& element, PlaneVector corner, PlaneVector direction);
/// It leaves along `direction` instead. False: that is a turn to the compensated side.
bool turn_corner(Element& element, PlaneVector direction);

/// The sweep of the offset arc between `element.begin` and `end`, which both lie on it: the
/// programmed one, less what is cut off or plus what is added at either end. Below 0 when it runs
/// backwards.
double offset_sweep(const Element& element, PlaneVector end);

}  // namespace dripline::interpreter::compensation::impl
