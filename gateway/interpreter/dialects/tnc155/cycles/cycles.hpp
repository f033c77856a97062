#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// The seam for everything CYCL DEF and TCH PROBE do. Functions give false when the run cannot go
/// on (`Run::pause`). What they need to move is in path.hpp; calling a program is `call_program`
/// of flow.hpp; what they keep is in cycle_state.hpp.
namespace dripline::interpreter::tnc155 {

/// One sub-block of CYCL DEF. Transformations and the dwell act with their last sub-block; a
/// transformation calls `end_contour` (contour.hpp) before, and changes State::transformation by
/// `change_transformation` (path.hpp). What a machining cycle says is kept for calls.
bool define_cycle(Run& run, const Block& block);

/// A block of another kind follows a definition whose last sub-block has not come.
bool is_defining(const Run& run);

/// CYCL CALL, M99, and every positioning block under M89: runs the machining cycle defined last,
/// from where the tool stands.
bool call_cycle(Run& run);

/// M02, M30, END PGM: what of the cycles ends with the program.
void end_cycles(Run& run);

/// DEF BLK FORM; delivers a Blank event with the second of the two blocks.
bool define_blank(Run& run, const Block& block);
/// Where a blank is there and the tool called has no axis or another one than BLK FORM: the
/// control's graphics show nothing of it (spec 21), which a warning says.
void tell_graphics(Run& run);

/// TCH PROBE 0.0 and 0.1. Asks a ProbeQuestion; called again with `Run::answer`.
bool probe(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155
