#pragma once

#include <optional>
#include <vector>

#include "gateway/report/motion_journal.hpp"

namespace dripline::gateway {

/// What a machine had in hand when its run was cut off: it may have executed all of it, a part, or
/// nothing. Blocks in their order, from the first that is not on record as executed.
using InHand = std::vector<report::MotionJournal::Entry>;

/// The motion of them; what must wait for it, and all that follows, was never given to the machine.
InHand motion_of(InHand entries);

/// Counts what the axes have passed that rest at `at`: `executed` becomes the block that they have
/// ended at least. True: they have ended no other, and nothing is in hand any more.
bool resolve(InHand& in_hand, const std::optional<machine::GivenAction::Point>& at,
             report::Progress& executed);

/// 0: none.
std::uint64_t last_block(const InHand& in_hand);

}  // namespace dripline::gateway
