#pragma once

#include <span>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::charts {

struct ContourPoint {
  double u = 0, v = 0;
};

/// A measured point against a nominal contour.
struct ContourDeviation {
  ContourPoint foot;     ///< nearest point of the contour
  ContourPoint normal;   ///< to the left of its direction, length 1
  double along = 0;      ///< length of the contour up to the foot
  double deviation = 0;  ///< signed distance: above 0 is to the left of the contour's direction
};

inline constexpr std::size_t kMaxContourPoints = 20'000;

/// One for each actual point, in their order. Errors: LimitExceeded (fewer than 2 nominal points,
/// no actual one, too many, one beyond kMaxMagnitude, a contour without length).
Result<std::vector<ContourDeviation>> deviations(std::span<const ContourPoint> nominal,
                                                 std::span<const ContourPoint> actual);

}  // namespace dripline::charts
