#pragma once

#include <string_view>

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// Tool nose radius compensation (manual: G40 to G42, tool types): how G40, G41, G42, the tool's
/// data and G65 drive the shared stage that offsets the path.
namespace dripline::interpreter::centurion {

struct ControlOptions;
struct Run;

/// The control's rules: intersections only, no inserted elements.
compensation::Policy compensation_policy();
/// The active tool's nose, for the side of G41 (true) or G42, as the stage takes it. A mirrored
/// path swaps the sides.
compensation::Cutter nose_of(const Run& run, bool is_left);

/// Before the block's move: passes to the stage what G40-G42, the tool or the special flags
/// changed. False: nose compensation cannot be used with a scale factor below 0.
bool update_compensation(Run& run);
/// Moves in machine coordinates (G28, G53, M6) are made without compensation: cancel it before them
/// and resume it after them.
void cancel_compensation(Run& run);
void resume_compensation(Run& run);
/// False, with an alarm: compensation offsets the path, in which `what` has no meaning.
bool check_uncompensated(Run& run, std::string_view what);
/// Whether the moves given out lead to the program's point: those of compensation end beside it.
bool is_at_program(const Run& run);
/// Around the move of a G65 without P.
void suppress_output(Run& run, bool is_suppressed);

/// After every block: false, with the control's alarm, when the path cannot be offset.
bool check_path(Run& run);
/// The alarm of an arc that different factors of scaling have left without a circle.
bool refuse_misfit(Run& run);

}  // namespace dripline::interpreter::centurion
