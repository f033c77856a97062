#pragma once

#include <functional>
#include <vector>

#include "gateway/interpreter/dialects/rs274ngc/execution/arcs.hpp"

/// Curves of the plane as straight pieces.
namespace dripline::interpreter::rs274ngc {

/// The point of a curve at a value of its parameter; millimeters.
using Curve = std::function<PlanePoint(double)>;

/// Adds points along `curve` between two values of its parameter, the first left out: straight
/// pieces through them keep within `tolerance` of the curve, unless it takes more than 1024 of
/// them. The curve must not turn back more often than a cubic one does. Pure.
void add_pieces(const Curve& curve, double from, double to, double tolerance,
                std::vector<PlanePoint>& points);

/// Straight moves through the points, at the rate of the feed, or together in its time. The other
/// axes stay. Errors: a point that is no number.
bool follow_points(Run& run, const std::vector<PlanePoint>& points, const Feed& feed);

}  // namespace dripline::interpreter::rs274ngc
