#pragma once

#include <array>
#include <optional>
#include <span>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::machine {

/// By itself, as clang takes a nested class with initializers for one without a default.
struct GivenArc {
  std::size_t first = 0, second = 1;  ///< axes of its plane
  double center_first = 0, center_second = 0;
  double start_radius = 0, end_radius = 0;
  double start = 0, sweep = 0;  ///< radians, counterclockwise positive
};

/// A part of a program that a device was given, or will be, ahead of what it has reported: as much
/// of it as shows later, from where the axes rest, how far they have come. A plain value.
struct GivenAction {
  using Point = std::array<double, interpreter::kAxisCount>;  ///< machine coordinates
  enum class Kind : std::uint8_t {
    Motion,
    BlockEnd,  ///< of a block whose end is not that of an action
    Other,     ///< begins when everything before it was reported, and so does all that follows
  };
  using Arc = GivenArc;
  interpreter::Origin origin;
  Kind kind = Kind::Other;
  bool ends_block = false;
  Point from{}, end{};
  std::optional<Arc> arc;  ///< absent: a straight move
};

/// How many actions, from the first one on, are done when the axes rest at a point.
struct Reached {
  std::size_t least = 0, most = 0;  ///< they differ where the path passes the point more than once
  bool is_certain() const { return least == most; }
};
/// Nothing: the point is not on the path of the motion before the first action of another kind.
std::optional<Reached> reached(std::span<const GivenAction> actions, const GivenAction::Point& at);

}  // namespace dripline::machine
