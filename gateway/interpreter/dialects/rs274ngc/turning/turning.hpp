#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// LinuxCNC's lathe cycles G70 (finishing), G71 and G72 (roughing along Z and along X). A cycle's
/// line moves to its start and calls the contour; the lines of the contour are recorded, and where
/// the call ends the passes are made.
namespace dripline::interpreter::rs274ngc {

/// Checks the words of the line, moves to the start and begins to record.
bool begin_turning(Run& run);
/// A line of the contour that is not an O word.
bool record_contour_line(Run& run);
/// Whether the call of the contour has just ended.
inline bool is_contour_complete(const State& state) {
  return state.turning.code != 0 && state.calls.size() == state.turning.level;
}
/// Makes the passes of the recorded contour. False: an alarm, and nothing has moved.
bool make_turning(Run& run);
/// The tool is where the cycle began, whatever has been recorded.
void end_recording(Run& run);

}  // namespace dripline::interpreter::rs274ngc
