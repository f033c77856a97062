#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"

#include <fmt/core.h>
#include <array>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/tool_table.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// The orientation of a tool whose nose's center is positioned; so is that of 0, no lathe tool.
constexpr int kCenterd = 9;

/// D words name a slot or tool; without one, and to LinuxCNC with D0, it is the tool in the
/// spindle.
bool read_tool(Run& run, double& diameter, int& orientation) {
  const Words& words = run.block.words;
  const double written = words.value_or('D', run.state.tool.loaded);
  const double number = std::round(written);
  if (!(std::fabs(written - number) <= 0.0001)) return run.fail_word(ErrorCode::NotInteger, 'D');
  if (number < 0) return run.fail_word(ErrorCode::NegativeD, 'D', fmt::format("D{}", number));
  if (!run.is_linuxcnc() && number > run.options.slots) {
    return run.fail_word(ErrorCode::RadiusIndexRange, 'D',
                         fmt::format("D{} is above {}", number, run.options.slots));
  }
  const Tool* tool = find_tool_of_word(run, number);
  if (tool == nullptr && run.is_linuxcnc() && words.has('D') && number != 0) {
    return run.fail_word(ErrorCode::ToolNotFound, 'D', fmt::format("D{}", number));
  }
  diameter = tool ? tool->diameter : 0;
  orientation = tool ? tool->orientation : 0;
  return true;
}

/// D is the diameter itself, L the orientation of a lathe tool.
bool read_own_tool(Run& run, double& diameter, int& orientation) {
  const Words& words = run.block.words;
  if (!words.has('D')) return run.fail(ErrorCode::OffsetIndexMissing, 0, "no D word");
  diameter = run.mm(words['D']);
  if (!words.has('L')) return true;
  if (run.state.modes.plane != Plane::ZX) {
    return run.fail_word(ErrorCode::CompLathe, 'L', "L needs G18");
  }
  if (!(words['L'] <= kCenterd)) {
    return run.fail_word(ErrorCode::CompLathe, 'L',
                         fmt::format("L{} is not in 0 to {}", words['L'], kCenterd));
  }
  orientation = static_cast<int>(words['L']);
  return true;
}

bool switch_off(Run& run) {
  Compensation& compensation = run.state.compensation;
  if (compensation.side == Side::Off) return true;
  if (run.is_linuxcnc() && !stop_trimming(run)) return false;
  compensation.side = Side::Off;
  compensation.is_first = false;
  return true;
}

bool is_plane_allowed(const Run& run) {
  const Plane plane = run.state.modes.plane;
  return plane == Plane::XY || (run.is_linuxcnc() && plane == Plane::ZX);
}

}  // namespace

bool switch_compensation(Run& run, int g_code) {
  if (g_code == 400) return switch_off(run);
  Compensation& compensation = run.state.compensation;
  if (!is_plane_allowed(run)) return run.fail(ErrorCode::CompNotXy, 0);
  if (compensation.side != Side::Off) return run.fail(ErrorCode::CompOnTwice, 0);
  double diameter = 0;
  int orientation = 0;
  const bool is_own = g_code == 411 || g_code == 421;
  if (!(is_own ? read_own_tool(run, diameter, orientation)
               : read_tool(run, diameter, orientation))) {
    return false;
  }
  if (orientation == kCenterd) orientation = 0;
  if (orientation != 0 && run.state.modes.plane != Plane::ZX) {
    return run.fail(ErrorCode::CompLathe, 0, "a lathe tool needs G18");
  }
  if (run.state.rotation != 0 && run.state.modes.plane != Plane::XY) {
    return run.fail(ErrorCode::NotSupported, 0, "compensation in this plane of a turned system");
  }
  const bool is_left = (g_code < 420) == (diameter >= 0);
  compensation.side = is_left ? Side::Left : Side::Right;
  compensation.radius = std::fabs(diameter) / 2;
  compensation.orientation = static_cast<std::uint8_t>(orientation);
  compensation.is_first = true;
  // the one before is left by a straight move, whichever is on by then
  if (!run.is_linuxcnc()) compensation.was_on = false;
  return true;
}

bool compensated_line(Run& run, const Target& target, bool is_rapid, const Feed& feed) {
  return run.is_linuxcnc() ? trimmed_line(run, target, is_rapid, feed)
                           : nist_line(run, target, is_rapid, feed);
}

bool compensated_arc(Run& run, const Target& target, PlaneVector center, Turn turn,
                     double full_circles, const Feed& feed) {
  return run.is_linuxcnc() ? trimmed_arc(run, target, center, turn, full_circles, feed)
                           : nist_arc(run, target, center, turn, full_circles, feed);
}

void release_held(Run& run) {
  if (run.state.compensation.orientation != 0) shift_held_to_tip(run);
  run.held.release(run.sink);
}

// Shared by both methods.

PlaneVector point_of(const Run& run, const Axes& axes) {
  const PlaneAxes plane = axes_of(run.state.modes.plane);
  return {axes[index_of(plane.first)], axes[index_of(plane.second)]};
}

PlaneVector tool_point(const Run& run) {
  return point_of(run, run.state.position);
}

Target moved_to(const Run& run, const Target& target, PlaneVector to) {
  const PlaneAxes plane = axes_of(run.state.modes.plane);
  Target moved = target;
  moved.to[index_of(plane.first)] = to.first;
  moved.to[index_of(plane.second)] = to.second;
  moved.named = static_cast<AxisBits>(moved.named | bit_of(plane.first) | bit_of(plane.second));
  return moved;
}

Target corner_end(const Run& run, const Target& next, PlaneVector to) {
  constexpr AxisBits kXyz = bit_of(Axis::X) | bit_of(Axis::Y) | bit_of(Axis::Z);
  Target corner = next;
  corner.named = static_cast<AxisBits>(next.named & ~kXyz);
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    corner.to[index_of(axis)] = run.state.position[index_of(axis)];
  return moved_to(run, corner, to);
}

bool is_inside(const Run& run, Turn turn) {
  return (run.state.compensation.side == Side::Left) == (turn == Turn::Counterclockwise);
}

double side_sign(const Run& run) {
  return run.state.compensation.side == Side::Left ? 1 : -1;
}

double turned_into(double radians, double lowest) {
  constexpr double kFull = 2 * Angle::kPi;
  return radians - kFull * std::floor((radians - lowest) / kFull);
}

namespace {

/// From the center of the nose to the tip, in the plane ZX.
PlaneVector tip_of(const Compensation& compensation) {
  constexpr std::array<double, 9> kAlongZ{0, 1, -1, -1, 1, 1, 0, -1, 0};
  constexpr std::array<double, 9> kAlongX{0, -1, -1, 1, 1, 0, -1, 0, 1};
  const std::size_t quadrant = compensation.orientation;
  return {compensation.radius * kAlongZ[quadrant], compensation.radius * kAlongX[quadrant]};
}

void shift(Position& to, PlaneVector by) {
  to.set_raw(Axis::Z, to.raw(Axis::Z) + by.first);
  to.set_raw(Axis::X, to.raw(Axis::X) + by.second);
}

}  // namespace

void shift_held_to_tip(Run& run) {
  const PlaneVector tip = tip_of(run.state.compensation);
  for (auto& event : run.held.events()) {
    if (auto* line = std::get_if<Line>(&event)) shift(line->to, tip);
    if (auto* rapid = std::get_if<Rapid>(&event)) shift(rapid->to, tip);
    auto* arc = std::get_if<Arc>(&event);
    if (arc == nullptr) continue;
    shift(arc->to, tip);
    arc->center_first += Length::mm(tip.first);
    arc->center_second += Length::mm(tip.second);
  }
}

}  // namespace dripline::interpreter::rs274ngc
