#pragma once

#include <array>
#include <optional>

#include "gateway/interpreter/stages/blending/impl/element.hpp"
#include "gateway/interpreter/stages/compensation/policy.hpp"
#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

namespace dripline::interpreter::blending::impl {

/// What the compensation stage after is told, in its place among the events.
struct CompensationCall {
  enum class Kind : std::uint8_t { TurnOn, TurnOnAs, TurnOff, Leave, SuppressOutput, Go };
  Kind kind = Kind::TurnOff;
  compensation::Cutter cutter;
  compensation::StartUp start_up = compensation::StartUp::NextNormal;  ///< of TurnOnAs
};
struct UncountedEnd {
  Origin origin;
};
}  // namespace dripline::interpreter::blending::impl

template <>
inline constexpr bool dripline::interpreter::look_ahead::kIsBlockEnd<
    dripline::interpreter::blending::impl::UncountedEnd> = true;

namespace dripline::interpreter::blending::impl {

/// Where the piece of a corner belongs that a block of its own told.
struct CornerPlace {
  Origin origin;
};

using Held = look_ahead::HeldEvents<CompensationCall, UncountedEnd, CornerPlace>;

/// Everything that decides what comes next; `visit_state` (state_bytes.cpp) lists every member:
/// add new ones there too.
struct State {
  bool has_element = false;
  Plane plane = Plane::XY;
  Position programmed;  ///< where the program thinks the machine is
  Position given;       ///< where it has been sent
  Announced next;
  /// An end of a block right after the element that waits, which most blocks have: kept apart from
  /// what comes later since this is quicker.
  bool has_end = false;
  Origin end;
  Held held;
  std::array<Element, 2> elements;
  std::uint8_t waiting_slot = 0;

  /// The element that waits, when there is one; the other place is the next one's.
  Element& waiting() { return elements[waiting_slot]; }
  const Element& waiting() const { return elements[waiting_slot]; }
  Element& spare() { return elements[1 - waiting_slot]; }
  void swap_elements() { waiting_slot = static_cast<std::uint8_t>(1 - waiting_slot); }
};

}  // namespace dripline::interpreter::blending::impl
