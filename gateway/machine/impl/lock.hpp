#pragma once

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine::impl {

/// The part of the panel that does not apply to an action: the program's OverrideInhibit before it.
struct Lock {
  interpreter::FeedHoldInhibit hold = interpreter::FeedHoldInhibit::AtOnce;
  bool feed_override = false, spindle_override = false, single_block = false;
  bool is_tapping = false;

  /// The panel as this action sees it. A handwheel drives the program in the place of its feeds.
  OperatorPanel seen(const OperatorPanel& panel) const {
    OperatorPanel seen = panel;
    if (feed_override || panel.handwheel) seen.feed_override = 1;
    if (panel.handwheel) seen.rapid_override = 1;
    if (spindle_override) seen.spindle_override = 1;
    if (single_block) seen.single_block = false;
    return seen;
  }
};

inline Lock lock_of(const interpreter::OverrideInhibit& event) {
  return {.hold = event.hold,
          .feed_override = event.feed_override,
          .spindle_override = event.spindle_override,
          .single_block = event.single_block,
          .is_tapping = event.is_tapping};
}

}  // namespace dripline::machine::impl
