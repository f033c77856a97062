#pragma once

#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"

/// The two methods of compensation, chosen by the profile; private to compensation*.cpp. Points are
/// program coordinates along the axes of the plane, in millimeters.
namespace dripline::interpreter::rs274ngc {

bool nist_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
bool nist_arc(Run& run, const Target& target, PlaneVector center, Turn turn, double full_circles,
              const Feed& feed);
bool trimmed_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
bool trimmed_arc(Run& run, const Target& target, PlaneVector center, Turn turn, double full_circles,
                 const Feed& feed);
/// Ends the path where the tool is. Errors: the last move cannot be made.
bool stop_trimming(Run& run);

/// A lathe tool is positioned by the tip of its nose; all is computed for the nose's center.
void shift_held_to_tip(Run& run);

/// Where the tool is, in the plane.
PlaneVector tool_point(const Run& run);
PlaneVector point_of(const Run& run, const Axes& axes);
/// The last end of the path as programmed.
inline PlaneVector programmed_point(const Run& run) {
  return {run.state.compensation.x, run.state.compensation.y};
}
inline void programmed_at(Run& run, PlaneVector at) {
  run.state.compensation.x = at.first;
  run.state.compensation.y = at.second;
  run.state.compensation.is_first = false;
}
/// `target` with another point of the plane; both axes are named.
Target moved_to(const Run& run, const Target& target, PlaneVector to);
/// The tool runs inside the arc.
bool is_inside(const Run& run, Turn turn);
/// +1 left of the path, -1 right of it.
double side_sign(const Run& run);
/// The direction of an arc around a corner.
inline Turn corner_turn(const Run& run) {
  return side_sign(run) > 0 ? Turn::Clockwise : Turn::Counterclockwise;
}
inline constexpr double kQuarter = Angle::kPi / 2;
inline double direction(PlaneVector from, PlaneVector to) {
  return std::atan2(to.second - from.second, to.first - from.first);
}
inline PlaneVector along(PlaneVector from, double radians, double length) {
  return {from.first + length * std::cos(radians), from.second + length * std::sin(radians)};
}
/// In [lowest, lowest + 2 pi).
double turned_into(double radians, double lowest);

}  // namespace dripline::interpreter::rs274ngc
