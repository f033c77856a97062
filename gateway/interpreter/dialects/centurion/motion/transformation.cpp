#include "gateway/interpreter/dialects/centurion/motion/transformation.hpp"

#include <cmath>

#include "gateway/interpreter/core/language/expression.hpp"

namespace dripline::interpreter::centurion {
namespace {

Point rotated(const Point& point, const Point& center, double degrees) {
  const double sine = language::sine(degrees).value;
  const double cosine = language::cosine(degrees).value;
  const double z = point.z - center.z;
  const double x = point.x - center.x;
  return {center.x + z * sine + x * cosine, center.z + z * cosine - x * sine};
}

}  // namespace

bool Transformation::swaps_sides() const {
  bool swaps = mirrors_x != mirrors_z;
  if (scales && (factor.x < 0) != (factor.z < 0)) swaps = !swaps;
  return swaps;
}

double Transformation::length_factor() const {
  return scales ? std::fabs(factor.z) : 1;
}

Point Transformation::apply(Point point) const {
  if (mirrors_x) point.x = 2 * mirror.x - point.x;
  if (mirrors_z) point.z = 2 * mirror.z - point.z;
  if (scales) {
    point.x = scale_center.x + factor.x * (point.x - scale_center.x);
    point.z = scale_center.z + factor.z * (point.z - scale_center.z);
  }
  return rotates ? rotated(point, rotation_center, degrees) : point;
}

Point Transformation::undo(Point point) const {
  if (rotates) point = rotated(point, rotation_center, -degrees);
  if (scales) {
    point.x = scale_center.x + (point.x - scale_center.x) / factor.x;
    point.z = scale_center.z + (point.z - scale_center.z) / factor.z;
  }
  if (mirrors_x) point.x = 2 * mirror.x - point.x;
  if (mirrors_z) point.z = 2 * mirror.z - point.z;
  return point;
}

}  // namespace dripline::interpreter::centurion
