#include "gateway/interpreter/dialects/tnc155/itnc/cycle_tables.hpp"

#include <algorithm>

#include <array>

namespace dripline::interpreter::tnc155::itnc {
namespace {

using U = CycleUse;
using P = CycleParameter;

constexpr P kClearance{200, U::Distance}, kDepth{201, U::Length}, kSurface{203, U::Length},
    kSecond{204, U::Distance}, kPlunge{206, U::Feed}, kAtBottom{211, U::Seconds, false},
    kReference{395, U::Zero, false};

constexpr std::array kDrillingWords{kClearance,         kDepth,   kPlunge, P{202, U::Distance},
                                    P{210, U::Seconds}, kSurface, kSecond, kAtBottom,
                                    kReference};
constexpr std::array kReamingWords{kClearance,      kDepth,   kPlunge, kAtBottom,
                                   P{208, U::Feed}, kSurface, kSecond};
constexpr std::array kUniversalWords{kClearance,
                                     kDepth,
                                     kPlunge,
                                     P{202, U::Distance},
                                     P{210, U::Seconds},
                                     kSurface,
                                     kSecond,
                                     P{212, U::Distance},
                                     P{213, U::Number},
                                     P{205, U::Distance},
                                     kAtBottom,
                                     P{208, U::Feed},
                                     P{256, U::Distance, false},
                                     kReference};
constexpr std::array kPeckingWords{kClearance,
                                   kDepth,
                                   kPlunge,
                                   P{202, U::Distance},
                                   kSurface,
                                   kSecond,
                                   P{212, U::Distance},
                                   P{205, U::Distance},
                                   P{258, U::Distance},
                                   P{259, U::Distance},
                                   P{257, U::Distance},
                                   P{256, U::Distance},
                                   kAtBottom,
                                   P{379, U::Zero, false},
                                   P{253, U::Feed, false},
                                   P{208, U::Feed, false},
                                   kReference};
constexpr std::array kCenteringWords{
    kClearance, P{343, U::Zero}, kDepth,   P{344, U::Length, false},
    kPlunge,    kAtBottom,       kSurface, kSecond};
constexpr std::array kTappingWords{kClearance, kDepth, kPlunge, kAtBottom, kSurface, kSecond};
constexpr std::array kRigidWords{kClearance, kDepth, P{239, U::Length}, kSurface, kSecond};
constexpr std::array kBoringWords{kClearance,
                                  kDepth,
                                  kPlunge,
                                  kAtBottom,
                                  P{208, U::Feed},
                                  kSurface,
                                  kSecond,
                                  P{214, U::Distance},
                                  P{336, U::Zero, false}};
constexpr std::array kChipTapWords{kClearance,
                                   kDepth,
                                   P{239, U::Length},
                                   kSurface,
                                   kSecond,
                                   P{257, U::Distance},
                                   P{256, U::Distance},
                                   P{336, U::Zero, false},
                                   P{403, U::Number, false}};
constexpr std::array kBackBoringWords{kClearance,
                                      P{249, U::Length},
                                      P{250, U::Distance},
                                      P{251, U::Distance},
                                      P{252, U::Distance},
                                      P{253, U::Feed},
                                      P{254, U::Feed},
                                      P{255, U::Seconds},
                                      kSurface,
                                      kSecond,
                                      P{214, U::Distance},
                                      P{336, U::Zero, false}};
constexpr std::array kPolarWords{kClearance,
                                 kSurface,
                                 kSecond,
                                 P{216, U::Length},
                                 P{217, U::Length},
                                 P{244, U::Distance},
                                 P{245, U::Number},
                                 P{246, U::Number},
                                 P{247, U::Number},
                                 P{241, U::Number},
                                 P{301, U::Distance},
                                 P{365, U::Zero, false}};
constexpr std::array kCartesianWords{kClearance,        kSurface,           kSecond,
                                     P{225, U::Length}, P{226, U::Length},  P{237, U::Length},
                                     P{238, U::Length}, P{242, U::Number},  P{243, U::Number},
                                     P{224, U::Number}, P{301, U::Distance}};
constexpr P kExtent{215, U::Number}, kSide{368, U::Distance}, kMilling{207, U::Feed},
    kClimb{351, U::Number}, kInfeed{202, U::Distance}, kFloor{369, U::Distance},
    kFinishInfeed{338, U::Distance, false}, kOverlap{370, U::Number}, kEntry{366, U::Number},
    kFinishFeed{385, U::Feed, false}, kFeedReference{439, U::Zero, false};
constexpr std::array kRectangularPocketWords{kExtent,
                                             P{218, U::Distance},
                                             P{219, U::Distance},
                                             P{220, U::Distance},
                                             kSide,
                                             P{224, U::Number},
                                             P{367, U::Number},
                                             kMilling,
                                             kClimb,
                                             kDepth,
                                             kInfeed,
                                             kFloor,
                                             kPlunge,
                                             kFinishInfeed,
                                             kClearance,
                                             kSurface,
                                             kSecond,
                                             kOverlap,
                                             kEntry,
                                             kFinishFeed,
                                             kFeedReference};
constexpr std::array kCircularPocketWords{kExtent,       P{223, U::Distance},
                                          kSide,         kMilling,
                                          kClimb,        kDepth,
                                          kInfeed,       kFloor,
                                          kPlunge,       kFinishInfeed,
                                          kClearance,    kSurface,
                                          kSecond,       kOverlap,
                                          kEntry,        kFinishFeed,
                                          kFeedReference};
constexpr std::array kSlotWords{kExtent,
                                P{218, U::Distance},
                                P{219, U::Distance},
                                kSide,
                                P{374, U::Number},
                                P{367, U::Number},
                                kMilling,
                                kClimb,
                                kDepth,
                                kInfeed,
                                kFloor,
                                kPlunge,
                                kFinishInfeed,
                                kClearance,
                                kSurface,
                                kSecond,
                                kEntry,
                                kFinishFeed,
                                kFeedReference};
constexpr std::array kRoundSlotWords{kExtent,
                                     P{219, U::Distance},
                                     kSide,
                                     P{375, U::Distance},
                                     P{367, U::Zero},
                                     P{216, U::Length},
                                     P{217, U::Length},
                                     P{376, U::Number},
                                     P{248, U::Number},
                                     P{378, U::Number},
                                     P{377, U::Number},
                                     kMilling,
                                     kClimb,
                                     kDepth,
                                     kInfeed,
                                     kFloor,
                                     kPlunge,
                                     kFinishInfeed,
                                     kClearance,
                                     kSurface,
                                     kSecond,
                                     kEntry,
                                     kFinishFeed,
                                     kFeedReference};
constexpr std::array kThreadWords{
    P{335, U::Distance}, P{239, U::Length}, kDepth,  P{355, U::Number}, P{253, U::Feed}, kClimb,
    kClearance,          kSurface,          kSecond, kMilling};
constexpr std::array kTuningWords{P{240, U::Number}, P{241, U::Number}};
constexpr std::array kPresetWords{P{339, U::Number}};
constexpr std::array kBoreMillingWords{kClearance,
                                       kDepth,
                                       kPlunge,
                                       P{334, U::Distance},
                                       kSurface,
                                       kSecond,
                                       P{335, U::Distance},
                                       P{342, U::Distance},
                                       P{351, U::Number, false}};

}  // namespace

std::span<const CycleParameter> cycle_table(int cycle) {
  switch (cycle) {
    case 200:
      return kDrillingWords;
    case 201:
      return kReamingWords;
    case 202:
      return kBoringWords;
    case 203:
      return kUniversalWords;
    case 204:
      return kBackBoringWords;
    case 205:
      return kPeckingWords;
    case 206:
      return kTappingWords;
    case 207:
      return kRigidWords;
    case 208:
      return kBoreMillingWords;
    case 209:
      return kChipTapWords;
    case kPolarPattern:
      return kPolarWords;
    case kCartesianPattern:
      return kCartesianWords;
    case 240:
      return kCenteringWords;
    case 251:
      return kRectangularPocketWords;
    case 252:
      return kCircularPocketWords;
    case 253:
      return kSlotWords;
    case 254:
      return kRoundSlotWords;
    case 262:
      return kThreadWords;
    case kTuning:
      return kTuningWords;
    case 247:
      return kPresetWords;
    default:
      return {};
  }
}

double value_of(std::span<const CycleParameter> rows, std::span<const double> values, int q) {
  const auto row = std::ranges::find(rows, q, &CycleParameter::q);
  return row == rows.end() ? 0 : values[static_cast<std::size_t>(row - rows.begin())];
}

}  // namespace dripline::interpreter::tnc155::itnc
