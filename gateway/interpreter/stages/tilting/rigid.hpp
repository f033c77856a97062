#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gateway/interpreter/core/event.hpp"

/// Points, directions and rotations of space. Right-handed; angles in degrees.
namespace dripline::interpreter::tilting {

/// X, Y, Z.
using Point3 = std::array<double, 3>;

inline Point3 operator+(const Point3& a, const Point3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point3 operator-(const Point3& a, const Point3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point3 operator*(double k, const Point3& a) {
  return {k * a[0], k * a[1], k * a[2]};
}
inline double dot(const Point3& a, const Point3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point3& a) {
  return std::sqrt(dot(a, a));
}

/// A rotation, row by row: `at[3 * row + column]`.
struct Matrix3 {
  std::array<double, 9> at{1, 0, 0, 0, 1, 0, 0, 0, 1};

  Point3 column(std::size_t i) const { return {at[i], at[3 + i], at[6 + i]}; }
};

inline Point3 operator*(const Matrix3& m, const Point3& p) {
  return {m.at[0] * p[0] + m.at[1] * p[1] + m.at[2] * p[2],
          m.at[3] * p[0] + m.at[4] * p[1] + m.at[5] * p[2],
          m.at[6] * p[0] + m.at[7] * p[1] + m.at[8] * p[2]};
}
inline Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 product;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 column = a * b.column(i);
    for (std::size_t row = 0; row < 3; ++row) product.at[3 * row + i] = column[row];
  }
  return product;
}
/// Of a rotation: the one back.
inline Matrix3 transposed(const Matrix3& m) {
  return {{m.at[0], m.at[3], m.at[6], m.at[1], m.at[4], m.at[7], m.at[2], m.at[5], m.at[8]}};
}
/// About the axis of X, Y or Z (0, 1, 2) through zero, counterclockwise as seen from its positive
/// end.
Matrix3 rotation_about(std::size_t axis, double degrees);

/// p becomes turn * p + shift.
struct Rigid {
  Matrix3 turn;
  Point3 shift{};

  Point3 operator()(const Point3& p) const { return turn * p + shift; }
  Rigid operator*(const Rigid& first) const { return {turn * first.turn, (*this)(first.shift)}; }
  Rigid inverse() const {
    const Matrix3 back = transposed(turn);
    return {back, -1 * (back * shift)};
  }
};

/// The linear axes of a position.
inline Point3 linear_of(const Position& at) {
  return {at.raw(Axis::X), at.raw(Axis::Y), at.raw(Axis::Z)};
}

}  // namespace dripline::interpreter::tilting
