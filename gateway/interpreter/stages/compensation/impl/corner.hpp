#pragma once

#include <optional>

#include "gateway/interpreter/stages/compensation/fault.hpp"
#include "gateway/interpreter/stages/compensation/impl/element.hpp"

namespace dripline::interpreter::compensation::impl {

/// How an element ends where the next one begins.
struct CornerEnd {
  PlaneVector end;  ///< of the compensated element
  std::optional<FaultKind> fault;
};

/// `first` ends where `second` begins. `tool` is where the tool is before a start-up move. Sets
/// `second.begin`, and `second.lead_in` (empty before) to the path from the end of the first.
CornerEnd round_corner(const Policy& policy, const Element& first, Element& second,
                       PlaneVector tool);

/// Where the offset lines or circles of two elements that follow one another meet, both taken as
/// unlimited: of two points the one nearer to the programmed corner. Circles and lines that only
/// just miss each other, by rounding, touch. Nothing for parallel lines and for curves apart.
std::optional<PlaneVector> meet(const Element& first, const Element& second);
/// Where their offset tangents at the corner meet; these must not be parallel.
PlaneVector tangents_meet(const Element& first, const Element& second);

}  // namespace dripline::interpreter::compensation::impl
