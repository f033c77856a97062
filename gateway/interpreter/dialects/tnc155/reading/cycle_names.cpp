#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

#include <array>

namespace dripline::interpreter::tnc155 {
namespace {

using enum CycleField;

constexpr std::array kPeckingParts{CyclePart{Name, "PECKING"}, CyclePart{Length, "SET-UP"},
                                   CyclePart{Length, "DEPTH"}, CyclePart{Length, "PECKG"},
                                   CyclePart{Dwell, "DWELL"},  CyclePart{Feed, "F"}};
constexpr std::array kTappingParts{CyclePart{Name, "TAPPING"}, CyclePart{Length, "SET-UP"},
                                   CyclePart{Length, "DEPTH"}, CyclePart{Dwell, "DWELL"},
                                   CyclePart{Feed, "F"}};
constexpr std::array kSlotParts{CyclePart{Name, "SLOT MILLING"},
                                CyclePart{Length, "SET-UP"},
                                CyclePart{Length, "DEPTH"},
                                CyclePart{Peck, "PECKING"},
                                CyclePart{Side, ""},
                                CyclePart{Side, ""},
                                CyclePart{Feed, "F"}};
constexpr std::array kPocketParts{
    CyclePart{Name, "POCKET MILLING"}, CyclePart{Length, "SET-UP"}, CyclePart{Length, "DEPTH"},
    CyclePart{Peck, "PECKING"},        CyclePart{Side, ""},         CyclePart{Side, ""},
    CyclePart{FeedTurn, "F"}};
constexpr std::array kCircularPocketParts{
    CyclePart{Name, "CIRCULAR POCKET"}, CyclePart{Length, "SET-UP"}, CyclePart{Length, "DEPTH"},
    CyclePart{Peck, "PECKING"},         CyclePart{Radius, "RADIUS"}, CyclePart{FeedTurn, "F"}};
constexpr std::array kShiftParts{CyclePart{Name, "DATUM SHIFT"}, CyclePart{Shift, ""},
                                 CyclePart{Shift, ""}, CyclePart{Shift, ""}, CyclePart{Shift, ""}};
constexpr std::array kMirrorParts{CyclePart{Name, "MIRROR IMAGE"}, CyclePart{Axes, ""}};
constexpr std::array kDwellParts{CyclePart{Name, "DWELL TIME"}, CyclePart{Dwell, "DWELL"}};
constexpr std::array kRotationParts{CyclePart{Name, "ROTATION"}, CyclePart{Rotation, "ROT"}};
constexpr std::array kScalingParts{CyclePart{Name, "SCALING"}, CyclePart{Scale, "SCL"}};
constexpr std::array kProgramParts{CyclePart{Name, "PGM CALL"}, CyclePart{Program, "PGM"}};

}  // namespace

std::span<const CyclePart> cycle_parts(int cycle) {
  static constexpr std::array<std::span<const CyclePart>, kLastCycle + 1> kCycles{
      {{},
       kPeckingParts,
       kTappingParts,
       kSlotParts,
       kPocketParts,
       kCircularPocketParts,
       {},
       kShiftParts,
       kMirrorParts,
       kDwellParts,
       kRotationParts,
       kScalingParts,
       kProgramParts}};
  return cycle >= 0 && cycle < static_cast<int>(kCycles.size())
             ? kCycles[static_cast<std::size_t>(cycle)]
             : kCycles[0];
}

}  // namespace dripline::interpreter::tnc155
