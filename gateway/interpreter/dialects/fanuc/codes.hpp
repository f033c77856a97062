#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dripline::interpreter::fanuc {

// The preparatory functions of this control and their modal groups, numbered as the control's own
// list and #4001 and up number them. A code without a group is alarm 010.

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
  kMirrorGroup = 18,         ///< 22 on the control
  kInterpolationGroup = 19,  ///< 21 on the control
};
inline constexpr std::size_t kGroupCount = 20;
inline constexpr std::uint8_t kNoGroup = 0xFF;
/// Bit of Block::Parts::groups: a corner word makes more of a move.
inline constexpr unsigned kCornerBit = 31;

// Codes with a point are kept as these; all others as the number written.
inline constexpr std::uint8_t kMirrorOff = 150;          ///< G50.1
inline constexpr std::uint8_t kMirrorOn = 151;           ///< G51.1
inline constexpr std::uint8_t kPresetCoordinates = 152;  ///< G92.1
inline constexpr std::uint8_t kCylinder = 153;           ///< G07.1
inline constexpr std::uint8_t kMoreWorkSystems = 154;    ///< G54.1
inline constexpr std::uint8_t kContourControl = 155;     ///< G05.1
inline constexpr std::uint8_t kPolarPlaneOn = 156;       ///< G12.1
inline constexpr std::uint8_t kPolarPlaneOff = 157;      ///< G13.1
inline constexpr std::uint8_t kTipControl = 158;         ///< G43.4
inline constexpr std::uint8_t kTiltedPlane = 159;        ///< G68.2
inline constexpr std::uint8_t kAxisDirection = 164;      ///< G53.1
inline constexpr std::uint8_t kTipVector = 165;          ///< G43.5
inline constexpr std::uint8_t kRigidTap = 166;           ///< G84.2
inline constexpr std::uint8_t kRigidTapLeft = 167;       ///< G84.3

// Of lathes, whose numbers depend on the G-code system.
inline constexpr std::uint8_t kBoxTurning = 160;      ///< G90 of system A
inline constexpr std::uint8_t kBoxThread = 161;       ///< G92
inline constexpr std::uint8_t kBoxFacing = 162;       ///< G94
inline constexpr std::uint8_t kVariableThread = 163;  ///< G34
inline constexpr std::uint8_t kTurningCycles = 170;   ///< G70; those to G76 follow

/// A code as a program writes it, in tenths.
struct WrittenCode {
  int tenths;
  std::uint8_t code;
};
inline constexpr std::array kCodesWithPoint{
    WrittenCode{51, kContourControl},   WrittenCode{71, kCylinder},
    WrittenCode{121, kPolarPlaneOn},    WrittenCode{131, kPolarPlaneOff},
    WrittenCode{501, kMirrorOff},       WrittenCode{511, kMirrorOn},
    WrittenCode{541, kMoreWorkSystems}, WrittenCode{921, kPresetCoordinates},
    WrittenCode{1070, kCylinder},       WrittenCode{1120, kPolarPlaneOn},
    WrittenCode{1130, kPolarPlaneOff},  WrittenCode{434, kTipControl},
    WrittenCode{531, kAxisDirection},   WrittenCode{682, kTiltedPlane},
    WrittenCode{435, kTipVector},       WrittenCode{842, kRigidTap},
    WrittenCode{843, kRigidTapLeft},
};
/// Of machines with a tilting table or head: they need to know how its axes lie. In tenths.
inline constexpr std::array kFiveAxisCodes{412, 413, 414, 415, 416, 422, 423, 424, 425,
                                           426, 434, 435, 531, 536, 682, 683, 684};

namespace detail {
constexpr std::array<std::uint8_t, 180> groups_of_codes() {
  std::array<std::uint8_t, 180> groups{};
  for (auto& group : groups) group = kNoGroup;
  const auto put = [&](std::uint8_t group, auto... codes) {
    ((groups[static_cast<std::size_t>(codes)] = group), ...);
  };
  put(kOneShot, 4, 5, 7, 8, 9, 10, 11, 27, 28, 29, 30, 31, 37, 39, 45, 46, 47, 48, 52, 53, 60, 65,
      92, kPresetCoordinates, kCylinder, kContourControl, kAxisDirection);
  put(kMotionGroup, 0, 1, 2, 3, 33, kBoxTurning, kBoxThread, kBoxFacing, kVariableThread);
  put(kOneShot, 170, 171, 172, 173, 174, 175, 176);
  put(kPlaneGroup, 17, 18, 19);
  put(kDistanceGroup, 90, 91);
  put(kStrokeGroup, 22, 23);
  put(kFeedGroup, 93, 94, 95);
  put(kUnitsGroup, 20, 21);
  put(kCompensationGroup, 40, 41, 42);
  put(kLengthGroup, 43, 44, 49, kTipControl, kTipVector);
  put(kCycleGroup, 73, 74, 76, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, kRigidTap, kRigidTapLeft);
  put(kReturnGroup, 98, 99);
  put(kScalingGroup, 50, 51);
  put(kModalCallGroup, 66, 67);
  put(kSpindleGroup, 96, 97);
  put(kWorkGroup, 54, 55, 56, 57, 58, 59, kMoreWorkSystems);
  put(kPathGroup, 61, 62, 63, 64);
  put(kRotationGroup, 68, 69, kTiltedPlane);
  put(kPolarGroup, 15, 16);
  put(kMirrorGroup, kMirrorOff, kMirrorOn);
  put(kInterpolationGroup, kPolarPlaneOn, kPolarPlaneOff);
  return groups;
}
}  // namespace detail

inline constexpr auto kGroupOfCode = detail::groups_of_codes();

constexpr std::uint8_t group_of(std::uint8_t code) {
  return code < kGroupOfCode.size() ? kGroupOfCode[code] : kNoGroup;
}

/// G84.2 and G84.3: rigid tapping without M29.
constexpr bool is_rigid_tap(std::uint8_t code) {
  return code == kRigidTap || code == kRigidTapLeft;
}
/// G43.4 and G43.5.
constexpr bool is_tip_control(std::uint8_t code) {
  return code == kTipControl || code == kTipVector;
}

/// A lathe's three sets of numbers; the codes here are named after those of system B and of the
/// machining centers.
enum class CodeSystem : std::uint8_t { A, B, C };

namespace detail {
using CodeTable = std::array<std::uint8_t, 100>;

constexpr CodeTable code_table(CodeSystem system) {
  CodeTable table{};
  for (auto& code : table) code = kNoGroup;
  for (const int code :
       {0,  1,  2,  3,  4,  5,  8,  9,  10, 11, 17, 18, 19, 22, 23, 27, 28, 29, 30, 31,
        40, 41, 42, 52, 53, 54, 55, 56, 57, 58, 59, 61, 63, 64, 65, 66, 67, 96, 97}) {
    table[static_cast<std::size_t>(code)] = static_cast<std::uint8_t>(code);
  }
  const auto put = [&table](std::size_t written, int code) {
    table[written] = static_cast<std::uint8_t>(code);
  };
  put(34, kVariableThread);
  put(system == CodeSystem::A ? 32 : 33, 33);
  put(system == CodeSystem::C ? 70 : 20, 20);
  put(system == CodeSystem::C ? 71 : 21, 21);
  for (int n = 0; n <= 6; ++n) {
    put(static_cast<std::size_t>((system == CodeSystem::C ? 72 : 70) + n), kTurningCycles + n);
  }
  put(system == CodeSystem::A ? 50 : 92, 92);
  if (system == CodeSystem::A) {
    put(90, kBoxTurning);
    put(92, kBoxThread);
    put(94, kBoxFacing);
    put(98, 94);
    put(99, 95);
    return table;
  }
  for (const int code : {90, 91, 94, 95, 98, 99}) put(static_cast<std::size_t>(code), code);
  put(system == CodeSystem::B ? 77 : 20, kBoxTurning);
  put(system == CodeSystem::B ? 78 : 21, kBoxThread);
  put(system == CodeSystem::B ? 79 : 24, kBoxFacing);
  return table;
}
}  // namespace detail

inline constexpr std::array kCodeTables{detail::code_table(CodeSystem::A),
                                        detail::code_table(CodeSystem::B),
                                        detail::code_table(CodeSystem::C)};

}  // namespace dripline::interpreter::fanuc
