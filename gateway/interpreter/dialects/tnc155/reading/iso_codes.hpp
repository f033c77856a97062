#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::interpreter::tnc155 {

inline constexpr std::uint8_t kIllegalCode = 0xFF;
inline constexpr std::uint8_t kDistanceCode = 0xFE;  ///< 90, 91

/// The group of a G code.
constexpr std::uint8_t group_of_code(int code) {
  constexpr auto number = [](IsoGroup group) { return static_cast<std::uint8_t>(group); };
  switch (code) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 5:
    case 6:
    case 7:
    case 10:
    case 11:
    case 12:
    case 13:
    case 15:
      return number(IsoGroup::Motion);
    case 17:
    case 18:
    case 19:
    case 20:
      return number(IsoGroup::Plane);
    case 40:
    case 41:
    case 42:
    case 43:
    case 44:
      return number(IsoGroup::Compensation);
    case 24:
    case 25:
    case 26:
    case 27:
      return number(IsoGroup::Corner);
    case 4:
    case 28:
    case 39:
    case 54:
    case 72:
    case 73:
    case 74:
    case 75:
    case 76:
    case 77:
    case 78:
    case 83:
    case 84:
      return number(IsoGroup::Cycle);
    case 79:
      return number(IsoGroup::Call);
    case 29:
      return number(IsoGroup::Pole);
    case 30:
    case 31:
      return number(IsoGroup::Blank);
    case 38:
      return number(IsoGroup::Stop);
    case 51:
    case 99:
      return number(IsoGroup::Tool);
    case 55:
      return number(IsoGroup::Probe);
    case 70:
    case 71:
      return number(IsoGroup::Unit);
    case 50:
      return number(IsoGroup::Protection);
    case 98:
      return number(IsoGroup::Label);
    case 90:
    case 91:
      return kDistanceCode;
    default:
      return kIllegalCode;
  }
}

constexpr std::array<std::uint8_t, 100> make_groups_of_codes() {
  std::array<std::uint8_t, 100> groups{};
  for (int code = 0; code < 100; ++code)
    groups[static_cast<std::size_t>(code)] = group_of_code(code);
  return groups;
}
inline constexpr std::array<std::uint8_t, 100> kGroupsOfCodes = make_groups_of_codes();

}  // namespace dripline::interpreter::tnc155
