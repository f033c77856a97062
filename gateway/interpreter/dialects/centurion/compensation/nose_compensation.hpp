#pragma once

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// Tool nose radius compensation (spec 9.4-9.6): how G40, G41, G42, the tool's data and G65 drive
/// the shared stage that offsets the path.
namespace dripline::interpreter::centurion {

struct ControlOptions;
struct Run;

/// The control's rules: pure intersections, no inserted pieces.
compensation::Policy compensation_policy();
/// The active tool's nose, for the side of G41 (true) or G42, as a stage would be given it. A
/// mirrored path swaps the sides.
compensation::Cutter nose_of(const Run& run, bool is_left);

/// Before the block's move: tells the stage what G40-G42, the tool or the special flags changed.
/// False: nose compensation does not go with a scale factor below 0 (spec 9.4).
bool update_compensation(Run& run);
/// Moves of the machine's own (G28, G53, M6) are made without compensation: `cancel` before them,
/// `resume` after.
void cancel_compensation(Run& run);
void resume_compensation(Run& run);
/// Around the move of a G65 without P.
void suppress_output(Run& run, bool is_suppressed);

/// After every block: false, with the control's alarm, when the path cannot be offset.
bool check_path(Run& run);

}  // namespace dripline::interpreter::centurion
