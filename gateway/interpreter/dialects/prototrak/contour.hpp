#pragma once

#include <optional>

#include "gateway/interpreter/dialects/prototrak/event_list.hpp"

namespace dripline::interpreter::prototrak {

inline constexpr double kNoise = 1e-9;  ///< mm

/// A straight or circular piece of a part's edge, in mm.
struct Element {
  bool is_arc = false;
  XY from, to;
  XY center;
  double radius = 0;
  bool is_counterclockwise = false;
};
Element element_of(const ProgramEvent& cut);

double distance(XY a, XY b);
/// Within a resolution step: so far, in mm, events may be apart and still be one corner
/// (decided here).
double join_tolerance(bool is_metric);
/// Of travel at an element's ends; unit length.
XY direction_at_start(const Element& element);
XY direction_at_end(const Element& element);
/// The point `by` to the left of `at`, seen along `direction`.
XY beside(XY at, XY direction, double by);
/// The corner bends left (> 0), right (< 0) or not at all: the sine of the change of direction.
double turn_at(const Element& first, const Element& second);

/// The conrad between two elements that meet: the arc that touches both on the inside of the turn,
/// nearest to the corner. nullopt: there is none that touches them within their length.
std::optional<Element> conrad(const Element& first, const Element& second, double radius);

}  // namespace dripline::interpreter::prototrak
