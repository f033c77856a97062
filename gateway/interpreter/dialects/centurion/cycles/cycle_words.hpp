#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The words of the drilling and grooving cycles, and what they leave for the next cycle: a
/// word that a block does not have keeps its value of an earlier cycle (manual: data of a cycle).

namespace dripline::interpreter::centurion {

/// P116-P148 as these cycles use them. Positions are work coordinates as programmed (X a diameter),
/// whatever G91 made of the words; distances are true lengths.
inline constexpr int kStepOver = 116;
inline constexpr int kRelief = 118;
inline constexpr int kGrooveEndZ = 123;
inline constexpr int kGrooveEndX = 124;
inline constexpr int kClearanceX = 139;
inline constexpr int kClearanceZ = 140;
inline constexpr int kFinalDepth = 141;
inline constexpr int kInitialLevel = 142;
inline constexpr int kPeckIncrement = 143;
inline constexpr int kFirstDepth = 144;
inline constexpr int kCycleFeed = 145;
inline constexpr int kPeckup = 146;
inline constexpr int kPeckClearance = 147;
inline constexpr int kCycleDwell = 148;

/// A position word: absolute, or under G91 measured from `from`. Stored, and given, as programmed.
double cycle_position_word(Run& run, Address address, int parameter, double from);

/// A word without a sign; a negative one is error 517.
bool cycle_length_word(Run& run, Address address, int parameter, double& value);
/// The same, but 0 is an error too.
bool cycle_step_word(Run& run, Address address, int parameter, double& value);

/// P: seconds to wait. Errors: 539.
bool cycle_dwell_word(Run& run, double& seconds);

/// F of this block, of an earlier cycle, or the feed in force. Errors: 519, also where the earlier
/// cycle's was per minute and G99 is in force, or the reverse.
bool cycle_feed_word(Run& run, Feed& feed);

// The cycles of one block without threads. Every word is checked before anything moves.

/// G90, cycle A: in along X, cut to the end, out along X, back to the start point (manual: G90).
bool cut_turning_box(Run& run);
/// G94, cycle B: in along Z, cut to the end, out along Z, back to the start point (manual: G94).
bool cut_facing_box(Run& run);

/// G81-G86 and G89 (manual): at the tool's X, along Z. One-shot: the next block does not repeat
/// them. Errors: 517, 518, 519, 520, 539, CycleTooLong.
bool run_drilling_cycle(Run& run);
/// G74 (grooves in a face, high-speed pecks) and G75 (grooves in a diameter): the same cycle along
/// Z and along X. Errors: 517, 519, CycleTooLong.
bool run_groove_cycle(Run& run);

}  // namespace dripline::interpreter::centurion
