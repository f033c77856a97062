#pragma once

#include <array>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

/// The curves that compensation moves the tool along, and where two of them meet. Pure; lengths in
/// millimeters.
namespace dripline::interpreter::rs274ngc {

/// A straight line without end through `at`, or a circle about `at`.
struct OffsetCurve {
  bool is_circle = false;
  PlaneVector at;
  PlaneVector along;  ///< of a line: its direction, of length 1
  double radius = 0;  ///< of a circle
};

struct Meeting {
  int count = 0;  ///< 0: they do not meet, or nowhere in particular
  std::array<PlaneVector, 2> points{};
};
/// Of two points on a line the first is further along it; of two circles it is left of the line
/// from the center of `a` to that of `b`.
Meeting meet(const OffsetCurve& a, const OffsetCurve& b);

inline PlaneVector of_length_one(PlaneVector vector) {
  return (1 / length(vector)) * vector;
}

}  // namespace dripline::interpreter::rs274ngc
