#pragma once

#include <array>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

inline constexpr std::array kAxisSlotList{IsoSlot::X, IsoSlot::Y, IsoSlot::Z,
                                          IsoSlot::A, IsoSlot::B, IsoSlot::C,
                                          IsoSlot::U, IsoSlot::V, IsoSlot::W};
inline constexpr unsigned kAxisSlots = 0x0FF8;
inline constexpr unsigned kCenterSlots = 0x0007;
inline constexpr unsigned kRadiusSlot = 1u << static_cast<unsigned>(IsoSlot::R);
inline constexpr unsigned kAngleSlot = 1u << static_cast<unsigned>(IsoSlot::H);

/// The words of a block to which G90 and G91 apply. The radius of a corner or a tool and the axes
/// of a mirror are not coordinates; a MIN corner (G30) is always absolute (manual: graphics, BLK
/// FORM).
inline unsigned distance_slots(const IsoBlock& block) {
  unsigned slots = block.slots;
  if (block.has(IsoGroup::Corner) || block.has(IsoGroup::Tool)) slots &= ~kRadiusSlot;
  if (block.has_code(IsoGroup::Cycle, 28) || block.has_code(IsoGroup::Blank, 30)) {
    slots &= ~kAxisSlots;
  }
  return slots;
}

/// Slots from X to W are in the order of `Axis`.
constexpr Axis axis_of_slot(IsoSlot slot) {
  return static_cast<Axis>(static_cast<unsigned>(slot) - static_cast<unsigned>(IsoSlot::X));
}
constexpr IsoSlot slot_of_axis(Axis axis) {
  return static_cast<IsoSlot>(static_cast<unsigned>(axis) + static_cast<unsigned>(IsoSlot::X));
}
/// The spindle axis of G17-G19; none of G20.
constexpr std::optional<Axis> axis_of_plane(int code) {
  if (code == 17) return Axis::Z;
  if (code == 18) return Axis::Y;
  if (code == 19) return Axis::X;
  return std::nullopt;
}
/// The inverse; only X, Y and Z have a plane function.
constexpr std::optional<std::uint8_t> plane_of_axis(Axis axis) {
  if (axis == Axis::Z) return std::uint8_t{17};
  if (axis == Axis::Y) return std::uint8_t{18};
  if (axis == Axis::X) return std::uint8_t{19};
  return std::nullopt;
}

// Words put into an ISO block, as the conversion from plain language does.

inline Value whole(std::int32_t number) {
  return Value::steps(number * Value::kStepsPerUnit);
}

inline void set_slot(IsoBlock& iso, IsoSlot slot, const Value& value, bool is_incremental) {
  iso.set(slot, value, is_incremental ? Distance::Incremental : Distance::Absolute);
}

inline void set_coordinates(IsoBlock& iso, const Block& block) {
  for (const Coordinate& coordinate : block.words()) {
    set_slot(iso, slot_of_axis(coordinate.axis), coordinate.value, coordinate.is_incremental);
  }
}

inline void set_parameter(IsoBlock& iso, std::size_t number, const IsoParameter& parameter) {
  iso.parameters = static_cast<std::uint8_t>(iso.parameters | 1u << number);
  iso.cycle[number] = parameter;
}

}  // namespace dripline::interpreter::tnc155
