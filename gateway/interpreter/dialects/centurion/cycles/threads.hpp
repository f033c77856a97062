#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

/// Threads (manual: G32, G34 to G36; G92; G76): single lines (G32, G34-G36), cycle 1 (G92), the
/// multiple cycle (G76). The lead is along the path; F and E of these blocks never change the feed.
namespace dripline::interpreter::centurion {

/// F and E of the block are the lead of a thread.
bool takes_lead(const Run& run);

/// G34: before the block's words are taken for a move, its K becomes the change of the lead.
void take_lead_change(Run& run);
/// A block with G32 to G36: instead of the line or the arc to `to`. `arc` is of a circular thread.
bool thread_to(Run& run, const Target& target, const std::optional<ThreadArc>& arc);

/// G92.
bool cut_single_thread(Run& run);
/// G76: all passes are made in this one block, up to 400.
bool cut_multiple_thread(Run& run);

}  // namespace dripline::interpreter::centurion
