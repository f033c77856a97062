#include "gateway/interpreter/stages/compensation/impl/intersection.hpp"

#include <algorithm>

#include "gateway/interpreter/core/geometry/plane_curves.hpp"

namespace dripline::interpreter::compensation::impl {
namespace {

// All below is relative to the corner, so that far-off coordinates cost no digits.

PlaneLine line_at_end(const Element& element) {
  return {element.direction_out, element.offset};
}
PlaneLine line_at_start(const Element& element) {
  return {element.direction_in, element.offset};
}
PlaneCircle circle_at_end(const Element& element) {
  return {element.arch.center - element.end, std::max(0.0, element.offset_radius_out())};
}
PlaneCircle circle_at_start(const Element& element) {
  return {element.arch.center - element.from, std::max(0.0, element.offset_radius_in())};
}

std::optional<PlaneVector> nearest(const std::optional<PointPair>& points) {
  if (!points) return std::nullopt;
  return points->nearest({});
}

std::optional<PlaneVector> meet_at_corner(const Element& first, const Element& second) {
  if (first.is_arc && second.is_arc)
    return nearest(meet(circle_at_end(first), circle_at_start(second)));
  if (first.is_arc) return nearest(meet(line_at_start(second), circle_at_end(first)));
  if (second.is_arc) return nearest(meet(line_at_end(first), circle_at_start(second)));
  return meet(line_at_end(first), line_at_start(second));
}

}  // namespace

std::optional<PlaneVector> meet(const Element& first, const Element& second) {
  const auto point = meet_at_corner(first, second);
  if (!point) return std::nullopt;
  return first.end + *point;
}

PlaneVector tangents_meet(const Element& first, const Element& second) {
  return first.end + crossing(line_at_end(first), line_at_start(second));
}

}  // namespace dripline::interpreter::compensation::impl
