#pragma once

namespace dripline::interpreter::centurion {

/// X is a radius.
struct Point {
  double x = 0;
  double z = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

}  // namespace dripline::interpreter::centurion
