#pragma once

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

/// PROBE1 and PROBE2: the move of G0 to G3 in their block ends where the probe trips (manual:
/// probing). It asks the machine, and the next block begins where the answer says.
namespace dripline::interpreter::centurion {

/// False: the block has no such move, or one of which the manual does not say what PROBE does.
bool check_probe(Run& run);
bool probe_line(Run& run, const Target& target);
/// `arc` as programmed, not transformed.
bool probe_arc(Run& run, const Arc& arc);
/// The answer.
void finish_probe(Run& run, const ProbeResult& result);

}  // namespace dripline::interpreter::centurion
