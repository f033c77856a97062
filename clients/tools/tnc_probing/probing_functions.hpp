#pragma once

#include <array>
#include <optional>
#include <span>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/transformation.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"
#include "protocol/base/result.hpp"

/// The touch probe functions of the manual and handwheel modes, with which an operator measures
/// before a program runs (manual: touch probe). Pure: contact points in, results out.
/// Lengths are millimeters in machine coordinates with the stylus length left out, angles degrees.
namespace dripline::tnc_probing {

using interpreter::Axis;
using interpreter::Plane;
using interpreter::PlaneVector;
using interpreter::Position;
using interpreter::Workpiece;
using interpreter::tnc155::ProbeDirection;
using interpreter::tnc155::Transformation;

/// The stylus as calibrated.
struct Stylus {
  double radius = 0;    ///< of the ball, effective
  double travel = 100;  ///< longest travel of one touch
};

/// One touch: from a place along one axis until contact.
struct Touch {
  Position from;
  Axis axis = Axis::Z;
  ProbeDirection direction = ProbeDirection::Negative;
};

/// The touches of a function: how many, and their directions.
enum class ProbingFunction : std::uint8_t { Length, Radius, Rotation, Surface, Corner, Circle };
std::size_t touches_of(ProbingFunction function);
/// Length: along the tool. Radius, circle: first axis of the plane +, -, then the second one +, -.
/// Rotation: both the same, in the plane. Corner: two the same for each side, along different axes
/// of the plane. Surface: any. Errors: Syntax, naming the touch and what is expected.
Result<void> check_touches(ProbingFunction function, std::span<const Touch> touches,
                           Axis tool_axis);

/// Where the stylus was at contact. Along U, V, W it moves as along X, Y, Z; about A, B, C it
/// circles the machine's zero, on the axis' side of a workpiece that lies as at 0 degrees, and
/// travel is in degrees. Errors: NotFound, TOUCH POINT INACCESSIBLE: no contact within the travel,
/// or deflected at the start; LimitExceeded (the ball is on the axis of rotation).
Result<Position> touch(const Workpiece& workpiece, const Stylus& stylus, const Touch& touch);

/// The surface's coordinate along the touch's axis: of the tip along the tool, of the ball's rim
/// across it; about an axis that of a wall through it.
double touched_coordinate(const Position& at, const Touch& touch, const Stylus& stylus,
                          Axis tool_axis);

/// The point that SURFACE = DATUM is about: the ball's rim where `frame` has turned the axis to.
Position touched_point(const Position& at, const Touch& touch, const Stylus& stylus, Axis tool_axis,
                       const Transformation& frame);

/// A program coordinate that a point of the machine is to have.
struct NamedCoordinate {
  Axis axis = Axis::X;
  double value = 0;
};
/// ... = DATUM: where the datum has to be, under the basic rotation of `frame`. Coordinates of the
/// point that are not named stay what they are with the frame's datum.
Transformation::Values datum_for(const Transformation& frame, const Position& point,
                                 std::span<const NamedCoordinate> named);

/// CALIBRATION EFFECTIVE LENGTH: by how much the stylus is longer than its length so far, so that
/// the plane touched has the coordinate `plane`.
double calibrated_length(const Position& at, Axis tool_axis, double plane);

/// CALIBRATION EFFECTIVE RADIUS: the ball's, from four touches inside a ring gauge, in the order
/// first axis +, -, second axis +, -. Errors: LimitExceeded (larger than the ring).
Result<double> calibrated_radius(std::span<const Position, 4> touches, Plane plane,
                                 double ring_radius);

/// BASIC ROTATION: the angle of the line through two touches, less the nominal one, within 90
/// degrees of it. Errors: LimitExceeded (the same point twice).
Result<double> basic_rotation(const Position& first, const Position& second, Plane plane,
                              double nominal);

/// A side of a corner: two touches of one direction.
struct Side {
  Touch first, second;
  Position first_at, second_at;
};
struct Corner {
  PlaneVector at;      ///< in the plane's axes
  double first_angle;  ///< PA of each side
  double second_angle;
};
/// CORNER = DATUM: where the walls meet, each beside the line of its touches by the ball's radius.
/// Two touches of a basic rotation are a side (TOUCH POINTS OF BASIC ROTATION?, ENT). Errors:
/// LimitExceeded (the sides are parallel).
Result<Corner> corner(const Side& first, const Side& second, const Stylus& stylus, Plane plane);

struct Circle {
  PlaneVector center;
  double radius = 0;  ///< PR
};
/// CIRCLE CENTRE = DATUM from four touches: first axis +, -, second axis +, -; of a bore they lead
/// outwards, of a boss inwards.
Circle circle_center(std::span<const Position, 4> touches, Plane plane, bool is_bore,
                     const Stylus& stylus);

}  // namespace dripline::tnc_probing
