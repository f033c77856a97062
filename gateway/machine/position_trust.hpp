#pragma once

#include <cstdint>

namespace dripline::machine {

/// How far the machine coordinates of a device can be those of an earlier program: what a restart
/// may rely on.
enum class PositionTrust : std::uint8_t {
  Kept,         ///< nothing was lost since that program began
  Reconnected,  ///< the device was connected since, and may have been switched off meanwhile
  Homed,        ///< the axes were homed
  Unlocked,     ///< the position was lost, and an operator has accepted what the device shows
  Lost          ///< the device was restarted, stopped while it moved, or is not homed
};

}  // namespace dripline::machine
