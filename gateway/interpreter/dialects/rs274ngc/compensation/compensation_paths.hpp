#pragma once

#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"

/// The two methods of compensation, chosen by the profile; private to compensation*.cpp. Points are
/// program coordinates along the axes of the plane, in millimeters.
namespace dripline::interpreter::rs274ngc {

bool nist_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
bool nist_arc(Run& run, const Target& target, PlanePoint center, Turn turn, double full_circles,
              const Feed& feed);
bool trimmed_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
bool trimmed_arc(Run& run, const Target& target, PlanePoint center, Turn turn, double full_circles,
                 const Feed& feed);
/// Ends the path where the tool is. Errors: the last move cannot be made.
bool stop_trimming(Run& run);

/// A lathe tool is positioned by the tip of its nose; all is computed for the nose's center.
void shift_held_to_tip(Run& run);

/// Where the tool is, in the plane.
PlanePoint tool_point(const Run& run);
PlanePoint point_of(const Run& run, const Axes& axes);
/// The last end of the path as programmed.
inline PlanePoint programmed_point(const Run& run) {
  return {run.state.compensation.x, run.state.compensation.y};
}
/// `target` with another point of the plane; both axes are named.
Target moved_to(const Run& run, const Target& target, PlanePoint to);
/// The tool runs inside the arc.
bool is_inside(const Run& run, Turn turn);
/// +1 left of the path, -1 right of it.
double side_sign(const Run& run);
inline double distance(PlanePoint a, PlanePoint b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}
inline double direction(PlanePoint from, PlanePoint to) {
  return std::atan2(to.second - from.second, to.first - from.first);
}
inline PlanePoint along(PlanePoint from, double radians, double length) {
  return {from.first + length * std::cos(radians), from.second + length * std::sin(radians)};
}
/// In [lowest, lowest + 2 pi).
double turned_into(double radians, double lowest);

}  // namespace dripline::interpreter::rs274ngc
