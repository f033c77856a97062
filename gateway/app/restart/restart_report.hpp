#pragma once

#include <optional>
#include <string>

#include "gateway/app/restart/approach.hpp"
#include "gateway/app/restart/checkpoint.hpp"
#include "gateway/app/restart/event_tracker.hpp"
#include "gateway/app/restart/restart_argument.hpp"
#include "gateway/interpreter/core/interpreter.hpp"

namespace dripline::gateway {

/// What the operator sees before anything moves.
struct RestartReport {
  report::ActiveRun original;
  RestartPlace at;
  std::uint64_t cut_off_at = 0;  ///< the block that the original run executed last
  std::uint64_t on_record = 0;  ///< as its record has it; the axes may show that it was a later one
  interpreter::Origin after;    ///< the last block that is not executed again
  std::uint64_t checkpoint = 0;  ///< block that the look-through began after
  /// The state's digest was that of a checkpoint's, at this block; absent: there was none to
  /// compare with.
  std::optional<std::uint64_t> state_equal_at;
  Digest state_digest;
  /// Everything from the checkpoint to the block was the same, move for move; absent: not recorded
  /// for this block.
  bool is_path_equal = false;
  /// All blocks were executed; the program's end is all that is left, and nothing moves.
  bool has_ended = false;
  DeliveredState delivered;
  interpreter::ActiveModes modes;
  std::optional<interpreter::CoordinateFrame> frame;
  interpreter::Position machine;  ///< where the axes are
  Approach::Plan approach;
  /// Put in after the retraction; nothing: the one in the spindle, as far as that is known.
  std::optional<int> tool_to_change;
  /// The lengths of that tool, less those of the one in the spindle.
  machine::ToolLengths length_change{};
  std::optional<interpreter::Position> stopped_at;  ///< where the original run came to rest
  EventTracker::Measured next;                      ///< the block that continues
};

/// JSON of at most dds::kMaxRecordText bytes.
std::string to_json(const RestartReport& report);

}  // namespace dripline::gateway
