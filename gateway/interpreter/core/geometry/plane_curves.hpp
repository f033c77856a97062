#pragma once

#include <optional>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

/// Where straight lines and circles without ends meet. Give coordinates relative to a point near
/// by: far-off ones cost digits. Curves that only just miss each other, by rounding, touch.
namespace dripline::interpreter {

struct PlaneLine {
  PlaneVector direction;  ///< of length 1
  double offset = 0;      ///< of the line from the origin, to the left of `direction`

  PlaneVector normal() const { return left_of(direction); }
  /// Its point nearest to the origin.
  PlaneVector foot() const { return offset * normal(); }
};
PlaneLine line_through(PlaneVector point, PlaneVector direction);

struct PlaneCircle {
  PlaneVector center;
  double radius = 0;
};

struct PointPair {
  PlaneVector one, other;
  PlaneVector nearest(PlaneVector to) const;
  PlaneVector farthest(PlaneVector from) const;
};

/// Nothing for parallel lines.
std::optional<PlaneVector> meet(const PlaneLine& a, const PlaneLine& b);
/// Of lines that are not parallel.
PlaneVector crossing(const PlaneLine& a, const PlaneLine& b);
/// Nothing when they miss each other; twice the same point when they touch.
std::optional<PointPair> meet(const PlaneLine& line, const PlaneCircle& circle);
std::optional<PointPair> meet(const PlaneCircle& a, const PlaneCircle& b);
/// Where the two tangents from `point` touch; nothing from a point inside.
std::optional<PointPair> touching_points(const PlaneCircle& circle, PlaneVector point);

}  // namespace dripline::interpreter
