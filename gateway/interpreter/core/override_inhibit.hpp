#pragma once

#include "gateway/interpreter/core/event.hpp"

/// The override inhibits of a tapping cycle, on every control that cuts the thread in step with the
/// spindle. `usual` are those that the program has set itself, where the control has codes for it.
namespace dripline::interpreter {

/// It is in force from the clearance plane to the bottom and back.
inline OverrideInhibit tapping_lock(const Origin& origin) {
  return {.origin = origin,
          .feed_override = true,
          .spindle_override = true,
          .single_block = true,
          .hold = FeedHoldInhibit::Later,
          .is_tapping = true};
}

/// It is in force for the rapid retraction: a hold that came in the hole waits for its end too.
inline OverrideInhibit lock_after_tap(OverrideInhibit usual) {
  if (usual.hold == FeedHoldInhibit::AtOnce) usual.hold = FeedHoldInhibit::LaterToo;
  return usual;
}

}  // namespace dripline::interpreter
