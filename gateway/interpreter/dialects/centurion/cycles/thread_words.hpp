#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

/// The words and parameters of a thread, shared by lines and cycles. Each reader keeps the value
/// where programs find it (P101-P108, P123-P125) and returns false with an alarm.
namespace dripline::interpreter::centurion {

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
