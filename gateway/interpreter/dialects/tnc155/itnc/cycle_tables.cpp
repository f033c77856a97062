#include "gateway/interpreter/dialects/tnc155/itnc/cycle_tables.hpp"

#include <algorithm>

#include <array>

namespace dripline::interpreter::tnc155::itnc {
namespace {

using enum CycleUse;
using P = CycleParameter;

constexpr P kClearance{200, Distance}, kDepth{201, Length}, kSurface{203, Length},
    kSecond{204, Distance}, kPlunge{206, Feed}, kAtBottom{211, Seconds, false},
    kReference{395, Zero, false};

constexpr std::array kDrillingWords{kClearance,       kDepth,          kPlunge,
                                    P{202, Distance}, P{210, Seconds}, kSurface,
                                    kSecond,          kAtBottom,       kReference};
constexpr std::array kReamingWords{kClearance,   kDepth,   kPlunge, kAtBottom,
                                   P{208, Feed}, kSurface, kSecond};
constexpr std::array kUniversalWords{kClearance,
                                     kDepth,
                                     kPlunge,
                                     P{202, Distance},
                                     P{210, Seconds},
                                     kSurface,
                                     kSecond,
                                     P{212, Distance},
                                     P{213, Number},
                                     P{205, Distance},
                                     kAtBottom,
                                     P{208, Feed},
                                     P{256, Distance, false},
                                     kReference};
constexpr std::array kPeckingWords{kClearance,
                                   kDepth,
                                   kPlunge,
                                   P{202, Distance},
                                   kSurface,
                                   kSecond,
                                   P{212, Distance},
                                   P{205, Distance},
                                   P{258, Distance},
                                   P{259, Distance},
                                   P{257, Distance},
                                   P{256, Distance},
                                   kAtBottom,
                                   P{379, Zero, false},
                                   P{253, Feed, false},
                                   P{208, Feed, false},
                                   kReference};
constexpr std::array kCenteringWords{kClearance, P{343, Zero}, kDepth,   P{344, Length, false},
                                     kPlunge,    kAtBottom,    kSurface, kSecond};
constexpr std::array kTappingWords{kClearance, kDepth, kPlunge, kAtBottom, kSurface, kSecond};
constexpr std::array kRigidWords{kClearance, kDepth, P{239, Length}, kSurface, kSecond};
constexpr std::array kBoringWords{kClearance, kDepth,           kPlunge,
                                  kAtBottom,  P{208, Feed},     kSurface,
                                  kSecond,    P{214, Distance}, P{336, Zero, false}};
constexpr std::array kChipTapWords{kClearance,
                                   kDepth,
                                   P{239, Length},
                                   kSurface,
                                   kSecond,
                                   P{257, Distance},
                                   P{256, Distance},
                                   P{336, Zero, false},
                                   P{403, Number, false}};
constexpr std::array kBackBoringWords{kClearance,       P{249, Length},   P{250, Distance},
                                      P{251, Distance}, P{252, Distance}, P{253, Feed},
                                      P{254, Feed},     P{255, Seconds},  kSurface,
                                      kSecond,          P{214, Distance}, P{336, Zero, false}};
constexpr std::array kPolarWords{kClearance,     kSurface,         kSecond,
                                 P{216, Length}, P{217, Length},   P{244, Distance},
                                 P{245, Number}, P{246, Number},   P{247, Number},
                                 P{241, Number}, P{301, Distance}, P{365, Zero, false}};
constexpr std::array kCartesianWords{
    kClearance,     kSurface,       kSecond,        P{225, Length}, P{226, Length},  P{237, Length},
    P{238, Length}, P{242, Number}, P{243, Number}, P{224, Number}, P{301, Distance}};
constexpr std::array kPresetWords{P{339, Number}};
constexpr std::array kBoreMillingWords{kClearance,       kDepth,           kPlunge,
                                       P{334, Distance}, kSurface,         kSecond,
                                       P{335, Distance}, P{342, Distance}, P{351, Number, false}};

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
