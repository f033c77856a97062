#pragma once

#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

/// G2 and G3 (9.3).
namespace dripline::interpreter::rs274ngc {

bool arc_move(Run& run, bool is_clockwise);

/// A point of the plane: first and second axis.
struct PlanePoint {
  double first = 0, second = 0;
};
/// Degrees from `start` to `end` about `center` in the direction of `turn`; a full turn when the
/// two are as good as the same. Pure.
double sweep_of(PlanePoint center, PlanePoint start, PlanePoint end, Turn turn);

}  // namespace dripline::interpreter::rs274ngc
