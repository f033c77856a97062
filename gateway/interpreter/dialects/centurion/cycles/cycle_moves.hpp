#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Moves of the drilling and grooving cycles. They are made in the coordinates the program is
/// written in, X as a radius, and never compensated (spec 11.9: the dimensions allow for the tool).
namespace dripline::interpreter::centurion {

/// Where the tool is.
Point cycle_position(const Run& run);

void cycle_rapid(Run& run, const Point& to);
/// The way to the clearance with which a cycle begins; in single block the operator is waited for
/// there (spec 11.7).
void cycle_rapid_to_clearance(Run& run, const Point& to);
void cycle_feed(Run& run, const Point& to, Feed feed);
void cycle_dwell(Run& run, double seconds);

/// As many moves as one block may cause: a machine queues a block as a whole. More is an alarm
/// before the first of them.
inline constexpr double kMaxCycleMoves = 2000;
bool check_cycle_length(Run& run, double moves);

/// Runs a drilling or grooving cycle with compensation suspended (manual: G40 to G42). Errors: the
/// control has no canned cycles.
bool run_canned_cycle(Run& run, bool (*cycle)(Run&));

/// Whether the spindle turns; what is done when not is an option of the control.
bool check_cycle_spindle(Run& run);

}  // namespace dripline::interpreter::centurion
