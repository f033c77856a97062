#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// Moves in program coordinates, output in machine coordinates. What positioning blocks, cycles and
/// the probe move with; the rules of compensation and corners are contour.hpp's.
namespace dripline::interpreter::tnc155 {

/// Bit per axis, as in kAllAxes.
using AxisMask = std::uint16_t;
constexpr AxisMask bit(Axis axis) {
  return static_cast<AxisMask>(1u << static_cast<unsigned>(axis));
}

/// How fast: rapid, or at a feed.
struct Pace {
  bool is_rapid = false;
  double feed = 0;         ///< millimeters per minute
  double rotary_feed = 0;  ///< degrees per minute: of a rotary axis alone
};
inline constexpr Pace kRapid{true, 0, 0};
/// The feed of an arc, which is never a rapid move, for F MAX: the highest feed that can be
/// entered, above that of every axis.
inline constexpr double kFeedAtRapid = 15'999;

/// Where a straight move goes: program coordinates of the axes in `named`.
struct Target {
  AxisValues at{};
  AxisMask named = 0;
  void set(Axis axis, double value) {
    at[static_cast<std::size_t>(axis)] = value;
    named = static_cast<AxisMask>(named | bit(axis));
  }
};

struct ArcTarget {
  Target to;  ///< both axes of the plane; a third one makes a helix
  PlaneVector center;
  Turn turn = Turn::Counterclockwise;
  double sweep = 0;  ///< degrees, > 0
};

/// Where the tool is, for moves that start from there. What a move does not name stays.
inline Target here(const State& state) {
  return {state.tool_position(), 0};
}
/// After a move to `target`: the nominal position follows along the axes that it names.
void arrive(State& state, const Target& target);

/// A straight move; the nominal position follows. A move of no length gives no event.
void line_to(Run& run, const Target& target, const Pace& pace);
/// Along an arc in the plane in force.
void arc_to(Run& run, const ArcTarget& target, const Pace& pace);
/// To a position in machine coordinates (M91): only the axes that are named.
void machine_line_to(Run& run, const Target& target, const Pace& pace);

/// The nominal position in the plane: that of the tool, except after R+ and R-.
PlaneVector nominal_in_plane(const State& state);

/// After State::transformation was changed: the tool does not move, and the nominal position
/// becomes that of the tool in the new coordinates.
void change_transformation(Run& run, const Transformation& changed);

/// Positions the machine would have: for graphics and probing.
Position machine_position(const State& state, const Target& target);

}  // namespace dripline::interpreter::tnc155
