#pragma once

#include "gateway/interpreter/event.hpp"

/// The locks of a tapping cycle, on every control that cuts the thread in step with the spindle.
/// `usual` is what the program locks anyway, where the control has codes for that.
namespace dripline::interpreter {

/// From the clearance down and back to it.
inline PanelLock tapping_lock(const Origin& origin) {
  return {.origin = origin,
          .feed_override = true,
          .spindle_override = true,
          .single_block = true,
          .hold = HoldRule::Later,
          .is_tapping = true};
}

/// The rapid way out behind it: a hold asked for in the hole waits for its end too.
inline PanelLock lock_behind_tap(PanelLock usual) {
  if (usual.hold == HoldRule::AtOnce) usual.hold = HoldRule::LaterToo;
  return usual;
}

}  // namespace dripline::interpreter
