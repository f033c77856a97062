#pragma once

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

}  // namespace dripline::interpreter::compensation::impl
