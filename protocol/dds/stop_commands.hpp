#pragma once

#include <string_view>

#include "protocol/dds/message.hpp"

/// Which orders stop or slow a machine down: one rule for both ends. Such orders never expire, and
/// no session, clock or protocol version keeps them back.
namespace dripline::dds {

/// Hold, abort, or an emergency stop that is pressed in.
inline bool is_stop(CommandAction action, std::string_view argument, double value) {
  if (action == CommandAction::Switch) return argument == "emergency_stop" && value == 1;
  return action == CommandAction::Hold || action == CommandAction::Abort;
}

inline bool is_override(CommandAction action) {
  return action == CommandAction::FeedOverride || action == CommandAction::RapidOverride ||
         action == CommandAction::SpindleOverride;
}

/// The member of `now` (a `Status`, a machine's panel) that an override order sets. `action` is one
/// of an override.
template <class Overrides>
auto& override_of(CommandAction action, Overrides& now) {
  return action == CommandAction::FeedOverride    ? now.feed_override
         : action == CommandAction::RapidOverride ? now.rapid_override
                                                  : now.spindle_override;
}

/// `value` is less than the override in force; never so of a NaN.
template <class Overrides>
bool lowers_override(CommandAction action, double value, const Overrides& now) {
  return is_override(action) && value < override_of(action, now);
}

}  // namespace dripline::dds
