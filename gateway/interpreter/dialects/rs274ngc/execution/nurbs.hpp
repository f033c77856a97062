#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// NURBS: G5.2 opens a curve and adds control points, G5.3 makes it (16.5).
///
/// A rational B-spline of order L (3 without), that is of degree L - 1, over a uniform knot vector
/// clamped at both ends: it begins at the first control point, which is where the tool is, and ends
/// at the last. The weight of the first is 1, or the P of a G5.2 without X and Y; every other point
/// has its own. Increments of G91 all count from where the tool is. Nothing moves before G5.3.
namespace dripline::interpreter::rs274ngc {

/// G5.2, or a line of points while it is in force.
bool add_control_point(Run& run);
/// G5.3. No motion mode is in force after it.
bool make_nurbs(Run& run);
/// Whether the codes of the line may appear between G5.2 and G5.3: none that moves the tool or its
/// coordinates.
bool fits_in_nurbs(Run& run);
/// At the program's end.
bool check_nurbs_closed(Run& run);

}  // namespace dripline::interpreter::rs274ngc
