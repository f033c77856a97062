#pragma once

#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

/// Cutter radius compensation, as each of the two programs does it: NIST appendix B, and LinuxCNC
/// as measured (tests/differential).
namespace dripline::interpreter::rs274ngc {

/// G40, G41, G42, G41.1, G42.1.
bool switch_compensation(Run& run, int g_code);

/// Compensation is on and moves are not where they are programmed. A tool without a radius makes
/// them as programmed; the later program then sets nothing up, so that G53 and an arc after G40 are
/// allowed. What compensation forbids of other codes stays forbidden.
inline bool shifts_moves(const Run& run) {
  const Compensation& compensation = run.state.compensation;
  return compensation.side != Side::Off && (compensation.radius > 0 || !run.is_linuxcnc());
}
bool compensated_line(Run& run, const Target& target, bool is_rapid, const Feed& feed);
/// `center` is that of the programmed path; with the NIST entry by radius it is not yet known.
bool compensated_arc(Run& run, const Target& target, PlaneVector center, Turn turn,
                     double full_circles, const Feed& feed);

/// After G40 the next move begins at the end of the path as programmed. A tool change takes the
/// tool's real place over instead, and axes that are not named stay there.
void continue_from_tool(Run& run);

/// Lets go of moves that are held back: the path ends or continues without compensation.
void release_held(Run& run);

}  // namespace dripline::interpreter::rs274ngc
