#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

/// Threads (manual: G32, G34 to G36; G92; G76): single lines (G32, G34-G36), cycle 1 (G92), the
/// multiple cycle (G76). The lead is along the path; F and E of these blocks never change the feed.

namespace dripline::interpreter::centurion {

/// P123, P124: where a cut that threads and the box cycles share ends; Z and a diameter.
inline constexpr int kEndPoint = 123;
inline constexpr int kDiameter = 124;

/// F and E of the block are the lead of a thread.
bool takes_lead(const Run& run);

/// G34: before the block's words are taken for a move, its K becomes the change of the lead.
void take_lead_change(Run& run);
/// A block with G32 to G36: instead of the line or the arc to `to`. `arc` is of a circular thread.
bool thread_to(Run& run, const Target& target, const std::optional<PathArc>& arc);

/// G92.
bool cut_single_thread(Run& run);
/// G76: all passes are made in this one block, up to 400.
bool cut_multiple_thread(Run& run);

// The words and parameters of a thread, shared by lines and cycles. Each reader keeps the value
// where programs find it (P101-P108, P123-P125) and returns false with an alarm.

struct Lead {
  double length = 0;            ///< per revolution, program units
  std::optional<double> shift;  ///< degrees; absent without Q
};
bool read_lead(Run& run, Lead& lead);

/// A word, or else what an earlier cycle left in parameter `number`.
double word_or_parameter(Run& run, Address address, int number);

/// The pull-out at the end of a thread: P103 long, P104 degrees from straight out (manual: G92).
struct ThreadChamfer {
  double along = 0;  ///< before the end, toward the start
  double out = 0;
};
bool read_chamfer(Run& run, ThreadChamfer& chamfer);

/// One pass: in at rapid, along the thread, out, and back to where the cycle began.
struct ThreadPass {
  Point start;     ///< of the cycle
  Point cut_from;  ///< where the thread begins
  Point cut_to;    ///< where it ends without the pull-out
};
bool check_pass(Run& run, const ThreadPass& pass, const ThreadChamfer& chamfer);
void cut_pass(Run& run, const ThreadPass& pass, const ThreadChamfer& chamfer, const Lead& lead);

/// Reads the end point of a cycle, which needs both of its words.
bool read_cycle_target(Run& run, Target& target);

}  // namespace dripline::interpreter::centurion
