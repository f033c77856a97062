#pragma once

#include "gateway/interpreter/rs274ngc/arcs.hpp"
#include "gateway/interpreter/rs274ngc/motion.hpp"

/// Cutter radius compensation in the XY plane, as each of the two programs does it (12, 15.6).
namespace dripline::interpreter::rs274ngc {

/// G40, G41, G42, G41.1, G42.1.
bool switch_compensation(Run& run, int g_code);

bool compensated_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
/// `center` is that of the programmed path; with the NIST entry by radius it is not yet known.
bool compensated_arc(Run& run, const Target& target, PlanePoint center, Turn turn, double turns,
                     const Feed& feed);

/// Lets go of moves that are held back: the path ends or goes on without compensation.
void release_held(Run& run);

}  // namespace dripline::interpreter::rs274ngc
