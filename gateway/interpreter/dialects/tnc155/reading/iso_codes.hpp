#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

inline constexpr std::uint8_t kIllegalCode = 0xFF;
inline constexpr std::uint8_t kDistanceCode = 0xFE;  ///< 90, 91

/// The group of each G code.
inline constexpr std::array<std::uint8_t, 100> kGroupsOfCodes = [] {
  std::array<std::uint8_t, 100> groups{};
  groups.fill(kIllegalCode);
  const auto put = [&](std::uint8_t group, auto... codes) {
    ((groups[std::size_t{codes}] = group), ...);
  };
  const auto add = [&](IsoGroup group, auto... codes) {
    put(static_cast<std::uint8_t>(group), codes...);
  };
  add(IsoGroup::Motion, 0u, 1u, 2u, 3u, 5u, 6u, 7u, 10u, 11u, 12u, 13u, 15u);
  add(IsoGroup::Plane, 17u, 18u, 19u, 20u);
  add(IsoGroup::Compensation, 40u, 41u, 42u, 43u, 44u);
  add(IsoGroup::Corner, 24u, 25u, 26u, 27u);
  add(IsoGroup::Cycle, 4u, 28u, 39u, 54u, 72u, 73u, 74u, 75u, 76u, 77u, 78u, 83u, 84u);
  add(IsoGroup::Call, 79u);
  add(IsoGroup::Pole, 29u);
  add(IsoGroup::Blank, 30u, 31u);
  add(IsoGroup::Stop, 38u);
  add(IsoGroup::Tool, 51u, 99u);
  add(IsoGroup::Probe, 55u);
  add(IsoGroup::Unit, 70u, 71u);
  add(IsoGroup::Protection, 50u);
  add(IsoGroup::Label, 98u);
  put(kDistanceCode, 90u, 91u);
  return groups;
}();

}  // namespace dripline::interpreter::tnc155
