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
  switch (cycle) {
    case 1:
      return kPecking;
    case 2:
      return kTapping;
    case 3:
      return kSlot;
    case 4:
      return kPocket;
    case 5:
      return kCircularPocket;
    case 7:
      return kShift;
    case 8:
      return kMirror;
    case 9:
      return kDwell;
    case 10:
      return kRotation;
    case 11:
      return kScaling;
    case 12:
      return kProgram;
    default:
      return {};
  }
}

}  // namespace dripline::interpreter::tnc155
