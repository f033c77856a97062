#pragma once

#include <functional>
#include <vector>

#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Curves in the XY plane, given as straight pieces within the option `spline_tolerance`
/// (LinuxCNC: G5 to G5.3).
namespace dripline::interpreter::rs274ngc {

/// G5 and G5.1: cubic and quadratic curves.
bool spline_move(Run& run, int g_code);

/// What every curve asks for: G17, no compensation, no axes but X and Y.
bool check_spline(Run& run);

// NURBS: G5.2 opens a curve and adds control points, G5.3 makes it.
//
// A rational B-spline of order L (3 without), that is of degree L - 1, over a uniform knot vector
// clamped at both ends: it begins at the first control point, which is where the tool is, and ends
// at the last. The weight of the first is 1, or the P of a G5.2 without X and Y; every other point
// has its own. Increments of G91 all count from where the tool is. Nothing moves before G5.3.

/// G5.2, or a line of points while it is in force.
bool add_control_point(Run& run);
/// G5.3. No motion mode is in force after it.
bool make_nurbs(Run& run);
/// Whether the codes of the line may appear between G5.2 and G5.3: none that moves the tool or its
/// coordinates.
bool fits_in_nurbs(Run& run);
/// At the program's end.
bool check_nurbs_closed(Run& run);

/// The point of a curve at a value of its parameter; millimeters.
using Curve = std::function<PlaneVector(double)>;

/// Adds points along `curve` between two values of its parameter, the first left out: straight
/// pieces through them keep within `tolerance` of the curve, unless it takes more than 1024 of
/// them. The curve must not turn back more often than a cubic one does. Pure.
void add_pieces(const Curve& curve, double from, double to, double tolerance,
                std::vector<PlaneVector>& points);

/// Straight moves through the points, at the rate of the feed, or together in its time. The other
/// axes stay. Errors: a point that is no number.
bool follow_points(Run& run, const std::vector<PlaneVector>& points, const Feed& feed);

}  // namespace dripline::interpreter::rs274ngc
