#pragma once

#include <cstdint>

/// How the moves of a contour are blended: the rules of a control as data.
namespace dripline::interpreter::blending {

struct Policy {
  /// Every feed move waits for the next one, which may still shape their corner. Off:
  /// only a move whose end was announced as a corner or an estimate.
  bool every_move_waits = true;
  /// Rapid moves are elements as feed moves are. Off: a rapid move ends the wait.
  bool blends_rapids = false;
  /// A corner whose next element never comes is a fault. Off: it is left out.
  bool refuses_open_corner = false;
  /// A rounding between elements that go straight on or straight back is a fault. Off: there is no
  /// corner to round where they go straight on; straight back stays a fault.
  bool refuses_straight_corner = true;
};

/// The meaning of the size of a chamfer.
enum class Chamfer : std::uint8_t {
  Leg,   ///< the length it takes of each of the two lines
  Face,  ///< its own length
};

/// Which of two points a line that is solved back to an arc begins at.
enum class Back : std::uint8_t {
  Nearest,   ///< the nearer to its end: the short line
  Farthest,  ///< the long line
};

}  // namespace dripline::interpreter::blending
