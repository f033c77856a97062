#pragma once

#include <array>
#include <cstdint>

/// The preparatory functions of this control and their modal groups, numbered as the control's own
/// list and #4001 and up number them. A code without a group is alarm 010.
namespace dripline::interpreter::fanuc {

enum Group : std::uint8_t {
  kOneShot = 0,
  kMotionGroup = 1,
  kPlaneGroup = 2,
  kDistanceGroup = 3,
  kStrokeGroup = 4,
  kFeedGroup = 5,
  kUnitsGroup = 6,
  kCompensationGroup = 7,
  kLengthGroup = 8,
  kCycleGroup = 9,
  kReturnGroup = 10,
  kScalingGroup = 11,
  kModalCallGroup = 12,
  kSpindleGroup = 13,
  kWorkGroup = 14,
  kPathGroup = 15,
  kRotationGroup = 16,
  kPolarGroup = 17,
};
inline constexpr std::size_t kGroupCount = 18;
inline constexpr std::uint8_t kNoGroup = 0xFF;
/// G54.1 and G05.1 are kept as these; all others as the number written.
inline constexpr std::uint8_t kMoreWorkSystems = 154;
inline constexpr std::uint8_t kContourControl = 155;

namespace detail {
constexpr std::array<std::uint8_t, 100> groups_of_codes() {
  std::array<std::uint8_t, 100> groups{};
  for (auto& group : groups) group = kNoGroup;
  const auto put = [&](std::uint8_t group, auto... codes) {
    ((groups[static_cast<std::size_t>(codes)] = group), ...);
  };
  put(kOneShot, 4, 5, 7, 8, 9, 10, 11, 27, 28, 29, 30, 31, 39, 45, 46, 47, 48, 52, 53, 60, 65, 92);
  put(kMotionGroup, 0, 1, 2, 3, 33);
  put(kPlaneGroup, 17, 18, 19);
  put(kDistanceGroup, 90, 91);
  put(kStrokeGroup, 22, 23);
  put(kFeedGroup, 94, 95);
  put(kUnitsGroup, 20, 21);
  put(kCompensationGroup, 40, 41, 42);
  put(kLengthGroup, 43, 44, 49);
  put(kCycleGroup, 73, 74, 76, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89);
  put(kReturnGroup, 98, 99);
  put(kScalingGroup, 50, 51);
  put(kModalCallGroup, 66, 67);
  put(kSpindleGroup, 96, 97);
  put(kWorkGroup, 54, 55, 56, 57, 58, 59);
  put(kPathGroup, 61, 62, 63, 64);
  put(kRotationGroup, 68, 69);
  put(kPolarGroup, 15, 16);
  return groups;
}
}  // namespace detail

inline constexpr std::array<std::uint8_t, 100> kGroupOfCode = detail::groups_of_codes();

constexpr std::uint8_t group_of(std::uint8_t code) {
  if (code == kMoreWorkSystems) return kWorkGroup;
  if (code == kContourControl) return kOneShot;
  return code < kGroupOfCode.size() ? kGroupOfCode[code] : kNoGroup;
}

}  // namespace dripline::interpreter::fanuc
