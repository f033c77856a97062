#pragma once

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"

/// Words of positioning blocks to coordinates, angles and feeds.
namespace dripline::interpreter::tnc155 {

/// Takes the block's coordinates over into `target`, incremental ones from the nominal position.
inline void read_coordinates(Run& run, const Block& block, Target& target) {
  run.ledger.take_all();
  for (const Coordinate& word : block.words()) {
    double value = run.coordinate(word.axis, word.value);
    if (word.is_incremental) value += run.state.nominal_of(word.axis);
    target.set(word.axis, value);
  }
}

/// PR and PA of LP: the point, and the values that later polar blocks continue from.
bool read_polar(Run& run, const Block& block, Target& target);

/// F of a cycle: of the cycle alone.
bool read_cycle_feed(Run& run, const Value& word, double& feed);
/// F: stays in force.
bool read_feed(Run& run, const Block& block);
/// How fast the block moves: FEED RATE MISSING without a feed.
bool pace_of(Run& run, const Block& block, Pace& pace);

PlaneMove plane_move(const State& state, const Target& target);
inline PlaneVector in_plane(const State& state, const Target& target) {
  const PlaneAxes axes = axes_of(state.plane);
  return {target.at[static_cast<std::size_t>(axes.first)],
          target.at[static_cast<std::size_t>(axes.second)]};
}
/// PATH OFFSET WRONGLY STARTED after R+ and R-: the tool is beside the point that the program
/// names, and which of the two an arc begins at is not stated.
bool check_arc_start(Run& run);
/// PLANE WRONGLY DEFINED where a circle in the plane in force would be none in the machine's.
bool check_circle_plane(Run& run);
void set_in_plane(const State& state, Target& target, PlaneVector to);
/// Marks both axes of the plane as programmed.
void name_plane(const State& state, Target& target);
bool names_plane(const State& state, const Target& target);
PlaneVector pole_in_plane(const State& state);
/// Of length 1; exact at multiples of 90 degrees.
PlaneVector unit_vector(double degrees);
/// Of length 1, where the element before ends; (0, 0) when it went nowhere.
PlaneVector end_direction(const LastMove& last);

}  // namespace dripline::interpreter::tnc155
