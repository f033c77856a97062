#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "gateway/interpreter/core/event.hpp"

/// What the screen of a control shows, as far as its own settings decide it.
namespace dripline::interpreter {

/// The position, where an operator chooses one.
enum class ShownPosition : std::uint8_t {
  NotChosen,
  Actual,
  Reference,
  FollowingError,
  Nominal,
  DistanceToGo,
};

struct ScreenSettings {
  std::optional<Units> units;  ///< of positions and feeds; absent: those of the program
  ShownPosition position = ShownPosition::NotChosen;
  /// Blocks that begin with one of these are shown in large characters: no other block beside them.
  std::string_view large_blocks;
  std::optional<std::bitset<kAxisCount>> axes;  ///< the control's; absent: all of the machine
};

/// Members of ActiveModes that not every control has, by their names in the API.
namespace status_field {
inline constexpr std::string_view kCompensation = "compensation", kToolLengthX = "tool_length_x",
                                  kToolLengthZ = "tool_length_z", kToolRadius = "tool_radius",
                                  kWorkSystem = "work_system", kIncremental = "incremental",
                                  kCycle = "cycle";
}  // namespace status_field

}  // namespace dripline::interpreter
