#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

#include <array>

namespace dripline::interpreter::tnc155 {
namespace {

using enum CycleField;

constexpr std::array kPecking{CyclePart{Name, "PECKING"}, CyclePart{Length, "SET-UP"},
                              CyclePart{Length, "DEPTH"}, CyclePart{Length, "PECKG"},
                              CyclePart{Dwell, "DWELL"},  CyclePart{Feed, "F"}};
constexpr std::array kTapping{CyclePart{Name, "TAPPING"}, CyclePart{Length, "SET-UP"},
                              CyclePart{Length, "DEPTH"}, CyclePart{Dwell, "DWELL"},
                              CyclePart{Feed, "F"}};
constexpr std::array kSlot{CyclePart{Name, "SLOT MILLING"},
                           CyclePart{Length, "SET-UP"},
                           CyclePart{Length, "DEPTH"},
                           CyclePart{Peck, "PECKING"},
                           CyclePart{Side, ""},
                           CyclePart{Side, ""},
                           CyclePart{Feed, "F"}};
constexpr std::array kPocket{
    CyclePart{Name, "POCKET MILLING"}, CyclePart{Length, "SET-UP"}, CyclePart{Length, "DEPTH"},
    CyclePart{Peck, "PECKING"},        CyclePart{Side, ""},         CyclePart{Side, ""},
    CyclePart{FeedTurn, "F"}};
constexpr std::array kCircularPocket{
    CyclePart{Name, "CIRCULAR POCKET"}, CyclePart{Length, "SET-UP"}, CyclePart{Length, "DEPTH"},
    CyclePart{Peck, "PECKING"},         CyclePart{Radius, "RADIUS"}, CyclePart{FeedTurn, "F"}};
constexpr std::array kShift{CyclePart{Name, "DATUM SHIFT"}, CyclePart{Shift, ""},
                            CyclePart{Shift, ""}, CyclePart{Shift, ""}, CyclePart{Shift, ""}};
constexpr std::array kMirror{CyclePart{Name, "MIRROR IMAGE"}, CyclePart{Axes, ""}};
constexpr std::array kDwell{CyclePart{Name, "DWELL TIME"}, CyclePart{Dwell, "DWELL"}};
constexpr std::array kRotation{CyclePart{Name, "ROTATION"}, CyclePart{Rotation, "ROT"}};
constexpr std::array kScaling{CyclePart{Name, "SCALING"}, CyclePart{Scale, "SCL"}};
constexpr std::array kProgram{CyclePart{Name, "PGM CALL"}, CyclePart{Program, "PGM"}};

}  // namespace

std::span<const CyclePart> cycle_parts(int cycle) {
  static constexpr std::array<std::span<const CyclePart>, kLastCycle + 1> kCycles{{{},
                                                                                   kPecking,
                                                                                   kTapping,
                                                                                   kSlot,
                                                                                   kPocket,
                                                                                   kCircularPocket,
                                                                                   {},
                                                                                   kShift,
                                                                                   kMirror,
                                                                                   kDwell,
                                                                                   kRotation,
                                                                                   kScaling,
                                                                                   kProgram}};
  return cycle >= 0 && cycle < static_cast<int>(kCycles.size())
             ? kCycles[static_cast<std::size_t>(cycle)]
             : kCycles[0];
}

}  // namespace dripline::interpreter::tnc155
