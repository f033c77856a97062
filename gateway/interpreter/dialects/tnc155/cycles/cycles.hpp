#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// CYCL DEF, CYCL CALL and TCH PROBE. Functions return false when the run cannot continue
/// (`Run::pause`). Their moves are those of path.hpp, `call_program` of flow.hpp calls a program,
/// and their state is in cycle_state.hpp.
namespace dripline::interpreter::tnc155 {

/// One sub-block of CYCL DEF. Transformations and the dwell act with their last sub-block; a
/// transformation calls `end_contour` (contour.hpp) before, and changes State::transformation by
/// `change_transformation` (path.hpp). The definition of a machining cycle is kept for its calls.
bool define_cycle(Run& run, const Block& block);

/// A block of another kind follows a definition whose last sub-block has not come.
bool is_defining(const Run& run);

/// CYCL CALL, M99, and every positioning block under M89: runs the machining cycle defined last,
/// from the position of the tool.
bool call_cycle(Run& run);

/// M02, M30, END PGM: ends the modal cycle call and the transformations that end with a program.
void end_cycles(Run& run);

/// DEF BLK FORM; delivers a Blank event with the second of the two blocks.
bool define_blank(Run& run, const Block& block);
/// Warns where there is a blank and the spindle axis of the tool is none or another than that of
/// BLK FORM: the control's graphics then show nothing (manual: graphics, BLK FORM).
void warn_of_graphics(Run& run);

/// TCH PROBE 0.0 and 0.1. Asks a ProbeQuestion; called again with `Run::answer`.
bool probe(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155
