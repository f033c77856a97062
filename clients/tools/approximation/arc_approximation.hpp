#pragma once

#include <cstdint>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/base/units.hpp"

/// Arcs by straight lines, for controls without circular interpolation (Tektronix 1704, "circle
/// approximation"; formulas re-derived).
namespace dripline::interpreter {

enum class ArcMethod : std::uint8_t {
  Chord,    ///< corners on the circle: the error lies inside, at most the tolerance
  Tangent,  ///< sides touch the circle: outside
  Secant,   ///< both: corners outside, sides inside; the fewest steps
};

struct ArcToApproximate {
  Length center_x, center_y;
  Length radius;  ///< of the tool's path: part radius and cutter radius
  Angle from;     ///< counterclockwise from +X
  Angle sweep;    ///< positive counterclockwise; up to 360 in either direction
  Length tolerance;
  ArcMethod method = ArcMethod::Chord;
};

struct PathPoint {
  Length x, y;
};

inline constexpr std::size_t kMaxApproximationPoints = 100'000;

/// The corners from the arc's begin to its end, both included and both on the circle. Errors:
/// LimitExceeded (radius, tolerance, sweep, or more points than kMaxApproximationPoints).
Result<std::vector<PathPoint>> approximate(const ArcToApproximate& arc);

}  // namespace dripline::interpreter
