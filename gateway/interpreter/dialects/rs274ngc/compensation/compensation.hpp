#pragma once

#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

/// Cutter radius compensation, as each of the two programs does it: NIST appendix B, and LinuxCNC
/// as measured (tests/differential).

namespace dripline::interpreter::rs274ngc {

/// G40, G41, G42, G41.1, G42.1.
bool switch_compensation(Run& run, int g_code);

/// Compensation is on and moves are not where they are programmed. A tool without a radius makes
/// them as programmed; the later program then sets nothing up, so that G53 and an arc after G40 are
/// allowed. What compensation forbids of other codes stays forbidden.
inline bool shifts_moves(const Run& run) {
  const Compensation& compensation = run.state.compensation;
  return compensation.side != Side::Off && (compensation.radius > 0 || !run.is_linuxcnc());
}
bool compensated_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
/// `center` is that of the programmed path; with the NIST entry by radius it is not yet known.
bool compensated_arc(Run& run, const Target& target, PlaneVector center, Turn turn,
                     double full_circles, const Feed& feed);

/// After G40 the next move begins at the end of the path as programmed. A tool change takes the
/// tool's real place over instead, and axes that are not named stay there.
void continue_from_tool(Run& run);

/// Lets go of moves that are held back: the path ends or continues without compensation.
void release_held(Run& run);

// The two methods of compensation, chosen by the profile; private to compensation*.cpp. Points are
// program coordinates along the axes of the plane, in millimeters.

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
/// The end of the corner arc before the move to `next`. Axes outside X, Y and Z, that of a rotary
/// table for example, make their whole travel on it; the plane's third axis stays for the move.
Target corner_end(const Run& run, const Target& next, PlaneVector to);
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
