#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Moves of the drilling and grooving cycles. They are made in the coordinates the program is
/// written in, X as a radius, and never compensated: the dimensions allow for the tool.
namespace dripline::interpreter::centurion {

/// The tool's position.
Point cycle_position(const Run& run);

void cycle_rapid(Run& run, const Point& to);
/// The rapid move to the clearance with which a cycle begins; in single block it waits there for
/// the operator (manual: drilling cycles).
void cycle_rapid_to_clearance(Run& run, const Point& to);
void cycle_feed(Run& run, const Point& to, Feed feed);
void cycle_dwell(Run& run, double seconds);

/// The maximum number of moves of one block, since a machine queues a block as a whole. More is an
/// alarm before the first of them.
inline constexpr double kMaxCycleMoves = 2000;
bool check_cycle_length(Run& run, double moves);

/// Runs a drilling or grooving cycle with compensation suspended (manual: G40 to G42). Errors: the
/// control has no canned cycles.
bool run_canned_cycle(Run& run, bool (*cycle)(Run&));

/// Checks that the spindle rotates; the option `cycle_spindle` decides what happens if not.
bool check_cycle_spindle(Run& run);

}  // namespace dripline::interpreter::centurion
