#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/iso_axes.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

/// Words put into an ISO block, as the conversion from plain language does.
namespace dripline::interpreter::tnc155 {

inline Value whole(std::int32_t number) {
  return Value::steps(number * Value::kStepsPerUnit);
}

inline void set_slot(IsoBlock& iso, IsoSlot slot, const Value& value, bool is_incremental) {
  iso.set(slot, value, is_incremental ? Distance::Incremental : Distance::Absolute);
}

inline void set_coordinates(IsoBlock& iso, const Block& block) {
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    const Coordinate& coordinate = block.coordinates[i];
    set_slot(iso, slot_of_axis(coordinate.axis), coordinate.value, coordinate.is_incremental);
  }
}

inline void set_parameter(IsoBlock& iso, std::size_t number, const IsoParameter& parameter) {
  iso.parameters = static_cast<std::uint8_t>(iso.parameters | 1u << number);
  iso.cycle[number] = parameter;
}

}  // namespace dripline::interpreter::tnc155
