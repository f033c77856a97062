#pragma once

#include <array>
#include <cstdint>

/// What the cycles do at a hole, as rows of steps (10.4, 15.3).
namespace dripline::interpreter::rs274ngc {

/// What a cycle does at a hole, one after the other.
enum class Step : std::uint8_t {
  End,
  FeedToBottom,
  FeedToClear,
  FeedToR,
  RapidToClear,
  Dwell,
  SpindleStop,
  SpindleReverse,
  SpindleRestore,
  OperatorStop,
  Peck,  ///< to the bottom in pecks, out of the hole between them
  Chip,  ///< the same, but only a little back
  BackBore,
};
using Steps = std::array<Step, 8>;

struct CycleRow {
  std::int16_t code;
  Steps steps;
  bool needs_p, needs_q, needs_ijk, needs_spindle;
};

/// The row of a cycle's G code, in tenths.
const CycleRow& cycle_row(int code, bool is_later);

}  // namespace dripline::interpreter::rs274ngc
