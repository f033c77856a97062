#pragma once

#include <string_view>

#include "protocol/dds/message.hpp"

/// The commands that stop or slow down a machine: one rule for both ends. They never expire, and no
/// session, clock or protocol version withholds them.
namespace dripline::dds {

/// Hold, abort, or a pressed emergency stop.
inline bool is_stop(CommandAction action, std::string_view argument, double value) {
  if (action == CommandAction::Switch) return argument == "emergency_stop" && value == 1;
  return action == CommandAction::Hold || action == CommandAction::Abort;
}

inline bool is_override(CommandAction action) {
  return action == CommandAction::FeedOverride || action == CommandAction::RapidOverride ||
         action == CommandAction::SpindleOverride;
}

/// The member of `now` (a `Status`, a machine's panel) that an override command sets. `action` is
/// that of an override.
template <class Overrides>
auto& override_of(CommandAction action, Overrides& now) {
  return action == CommandAction::FeedOverride    ? now.feed_override
         : action == CommandAction::RapidOverride ? now.rapid_override
                                                  : now.spindle_override;
}

/// Whether `value` is less than the override in force; false for a NaN.
template <class Overrides>
bool lowers_override(CommandAction action, double value, const Overrides& now) {
  return is_override(action) && value < override_of(action, now);
}

}  // namespace dripline::dds
