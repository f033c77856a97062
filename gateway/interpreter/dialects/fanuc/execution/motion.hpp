#pragma once

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// Where a block's words lead, and G00, G01, G31, G33, G53, G60.
namespace dripline::interpreter::fanuc {

/// In the order of Axis.
inline constexpr std::array<Address, kAxisCount> kWordOfAxis{X, Y, Z, A, B, C, U, V, W};

/// From the words, the distance mode and all transformations, in machine coordinates; named axes
/// are marked. False: alarm 003 or 143.
bool read_target(Run& run, Position& to);
/// A point of program coordinates as a machine position; other axes stay.
Position machine_point(const Run& run, const Point3& point);

/// A block of nothing but axis words and F while nothing special is in force.
bool execute_plain(Run& run);
/// Moves as the active code of group 01 says.
bool move(Run& run);
/// Rapid to `to`, from one direction when the block says G60.
bool position_to(Run& run, const Position& to);
bool move_in_machine_coordinates(Run& run);
/// G45 to G48: lengthens or shortens the travel.
bool offset_target(Run& run, Position& to);
/// Asks; the answer comes to finish_skip.
bool start_skip(Run& run);
void finish_skip(Run& run, const ProbeResult& result);
/// The answer to the open question takes the machine there.
Position finish_probe(Run& run, const ProbeResult& result);

/// F of the block, before anything else.
bool apply_feed(Run& run);
/// F of a block in G33: the lead, a length whatever the feed mode.
bool apply_lead(Run& run);
bool check_feed(Run& run);

/// G02, G03; arcs.cpp.
bool move_on_arc(Run& run);

// How all motion reaches the sink (path.cpp): stroke limits and imaginary axes. `to` is in
// machine coordinates, its marks say which axes have moved or are named. False: an alarm, before
// the move. The present position follows.

/// F of a straight move as its event has it: the control counts degrees as millimeters or inches.
Feed feed_on_line(const Run& run, const Position& from, const Position& to, const Feed& feed);
/// The same, unless a stage after cutter compensation sees to it.
Feed feed_into_stages(const Run& run, const Position& to, const Feed& feed);

bool rapid_to(Run& run, const Position& to);
bool line_to(Run& run, const Position& to, const Feed& feed);
bool thread_to(Run& run, const Position& to, Length lead, std::optional<Angle> start);
bool arc_to(Run& run, const Arc& arc);

/// The straight path, and how its text shows lengths.
struct StrokePath {
  const Position& from;
  const Position& to;
  LengthDisplay display;
};
/// What of the straight path is forbidden; empty: nothing.
std::string stroke_fault(const ControlOptions& options, const StrokeZone& zone,
                         const StrokePath& path);
/// Whether the straight path there keeps out of what is forbidden; else alarm OT500.
bool check_stroke(Run& run, const Position& to);
/// The tool is here, by whatever path.
inline void arrive(Run& run, const Position& to) {
  run.state.position = to;
  run.state.limits = {};
}

/// G27 to G30, by the block's one-shot code: reference points, which are machine coordinates;
/// coordinates.cpp.
bool execute_reference(Run& run);

}  // namespace dripline::interpreter::fanuc
