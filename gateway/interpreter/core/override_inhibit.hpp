#pragma once

#include "gateway/interpreter/core/event.hpp"

/// The locks of a tapping cycle, on every control that cuts the thread in step with the spindle.
/// `usual` is what the program locks anyway, where the control has codes for that.
namespace dripline::interpreter {

/// From the clearance down and back to it.
inline OverrideInhibit tapping_lock(const Origin& origin) {
  return {.origin = origin,
          .feed_override = true,
          .spindle_override = true,
          .single_block = true,
          .hold = FeedHoldInhibit::Later,
          .is_tapping = true};
}

/// The rapid way out after it: a hold asked for in the hole waits for its end too.
inline OverrideInhibit lock_after_tap(OverrideInhibit usual) {
  if (usual.hold == FeedHoldInhibit::AtOnce) usual.hold = FeedHoldInhibit::LaterToo;
  return usual;
}

}  // namespace dripline::interpreter
