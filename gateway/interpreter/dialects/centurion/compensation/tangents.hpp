#pragma once

#include <optional>

#include "gateway/interpreter/core/geometry/plane_curves.hpp"

/// The built-in geometry of TANL, TANA and CGEN (manual: TANL, TANA, CGEN). Plane vectors are (Z, X
/// radius), all in one unit. Pure.
namespace dripline::interpreter::centurion {

/// The side of the line from the first center to the second, seen along it.
enum class Beside : std::int8_t { Right = -1, Left = 1 };

struct TangentLine {
  PlaneCircle first, second;
  Beside on_first, on_second;  ///< the sides of the tangent points
};
struct TangentArc {
  PlaneCircle first, second;
  Beside on_first, on_second;
  Beside center;
  double radius = 0;
};
struct TangentPoints {
  PlaneVector on_first, on_second;
  PlaneVector center;  ///< of a tangent arc
};

/// Nothing where no such line or arc exists.
std::optional<TangentPoints> tangent_points(const TangentLine& line);
std::optional<TangentPoints> tangent_points(const TangentArc& arc);

struct ThreePoints {
  PlaneVector first, second, third;
};
struct CircleThrough {
  PlaneCircle circle;
  bool is_counterclockwise = false;  ///< from the first point over the second to the third
};
/// Nothing for points on one line.
std::optional<CircleThrough> circle_through(const ThreePoints& points);

}  // namespace dripline::interpreter::centurion
