#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// The way out of all motion: stroke limits and imaginary axes on the way to the sink. `to` is in
/// machine coordinates, its marks say which axes have moved or are named. False: an alarm, before
/// the move. The present position follows.
namespace dripline::interpreter::fanuc {

bool rapid_to(Run& run, const Position& to);
bool line_to(Run& run, const Position& to, const Feed& feed);
bool thread_to(Run& run, const Position& to, Length lead, std::optional<Angle> start);
bool arc_to(Run& run, const Arc& arc);

/// Whether the straight way there keeps out of what is forbidden; else alarm OT500.
bool check_stroke(Run& run, const Position& to);
/// The tool is here, whatever way it came.
inline void arrive(Run& run, const Position& to) {
  run.state.position = to;
  run.state.limits = {};
}

/// A point of an arc, by the angle traveled from its start.
Position point_on_arc(const Arc& arc, const Position& from, double degrees);

}  // namespace dripline::interpreter::fanuc
