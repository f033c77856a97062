#include <cmath>

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"

/// Where the words of PLANE have the plane. Source: iTNC 530, User's Manual, "Programming: multiple
/// axis machining": the PLANE function.
namespace dripline::interpreter::tnc155::itnc {
namespace {

using tilting::Matrix3;
using tilting::Point3;
using tilting::operator*;
using tilting::operator-;

Matrix3 from_columns(const Point3& x, const Point3& z) {
  const Point3 y = tilting::cross(z, x);
  return {{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}};
}

/// BX, BY, BZ: the plane's X axis; NX, NY, NZ: its normal. Both of any length, and at right angles.
bool frame_of_vectors(Run& run, const std::array<double, 6>& values, Matrix3& frame) {
  Point3 base{values[0], values[1], values[2]}, normal{values[3], values[4], values[5]};
  const double base_size = tilting::length(base), normal_size = tilting::length(normal);
  constexpr double kNoVector = 1e-9, kRight = 1e-3;
  if (base_size < kNoVector || normal_size < kNoVector)
    return run.fail(ErrorCode::EntryOutOfRange, "PLANE VECTOR: a vector has no length");
  base = (1 / base_size) * base;
  normal = (1 / normal_size) * normal;
  const double along = tilting::dot(base, normal);
  if (std::fabs(along) > kRight)
    return run.fail(ErrorCode::EntryOutOfRange,
                    "PLANE VECTOR: the vectors are not at right angles");
  base = base - along * normal;
  frame = from_columns((1 / tilting::length(base)) * base, normal);
  return true;
}

}  // namespace

/// Spatial angles are about the fixed axes X, then Y, then Z; Euler angles about Z, the X that it
/// has turned, and the Z that both have.
bool frame_of_plane(Run& run, const Matrix3& present, Matrix3& frame) {
  const PlaneWords& plane = run.parts.itnc.plane;
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!plane.values[i].empty() && !evaluate(run, plane.values[i], values[i])) return false;
  }
  const auto about = tilting::rotation_about;
  switch (plane.form) {
    case PlaneForm::Spatial:
      frame = about(2, values[2]) * about(1, values[1]) * about(0, values[0]);
      return true;
    case PlaneForm::Euler:
      frame = about(2, values[0]) * about(0, values[1]) * about(2, values[2]);
      return true;
    case PlaneForm::Vector:
      return frame_of_vectors(run, values, frame);
    default:
      frame = present * about(plane.axis, values[0]);
      return true;
  }
}

}  // namespace dripline::interpreter::tnc155::itnc
