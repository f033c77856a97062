#pragma once

#include <optional>

#include "gateway/interpreter/stages/compensation/impl/element.hpp"
#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

namespace dripline::interpreter::compensation::impl {

enum class Phase : std::uint8_t {
  Off,
  Starting,  ///< the next move in the plane is the start-up move
  On,
  Ending,    ///< the next move in the plane is the cancel move
  Parallel,  ///< the next move in the plane keeps the tool's distance, then off
};

/// Everything that decides what comes next, in a few fixed kilobytes; `visit_state`
/// (state_bytes.cpp) lists every member: add new ones there too.
struct State {
  Phase phase = Phase::Off;
  bool has_element = false;
  /// The tool is not on the programmed point of the plane, and stays where it is until the next
  /// move in the plane.
  bool is_displaced = false;
  bool is_output_suppressed = false;  ///< moves are silent elements
  Plane plane = Plane::XY;
  double offset = 0;  ///< to the left
  PlaneVector tip;    ///< from the nose center to the positioned point
  StartUp start_up = StartUp::NextNormal;
  std::optional<OutsideCorner> next_corner;
  std::optional<ByArc> next_arc;  ///< of the cancel move
  bool begins_contour = false;    ///< Parallel: a contour begins where that move ends
  int idle_blocks = 0;            ///< without motion in the plane, since the element that waits
  Position programmed;            ///< where the program thinks the machine is
  Position tool;                  ///< where it has been sent
  look_ahead::HeldEvents<> held;
  std::array<Element, 2> elements;
  std::uint8_t waiting_slot = 0;

  /// The element that waits, when there is one; the other place is the next one's.
  Element& waiting() { return elements[waiting_slot]; }
  const Element& waiting() const { return elements[waiting_slot]; }
  Element& spare() { return elements[1 - waiting_slot]; }
  void swap_elements() { waiting_slot = static_cast<std::uint8_t>(1 - waiting_slot); }
};

}  // namespace dripline::interpreter::compensation::impl
