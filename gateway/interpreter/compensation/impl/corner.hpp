#pragma once

#include "gateway/interpreter/compensation/fault.hpp"
#include "gateway/interpreter/compensation/impl/element.hpp"

namespace dripline::interpreter::compensation::impl {

/// What is decided where one element goes over into the next.
struct Corner {
  PlaneVector end;    ///< of the compensated first element
  PlaneVector begin;  ///< of the compensated second element
  LeadIn between;     ///< how the tool gets from `end` to `begin`
  std::optional<FaultKind> fault;
};

/// `first` ends where `second` begins. `tool` is where the tool stands before a start-up move.
Corner round_corner(const Policy& policy, const Element& first, const Element& second,
                    PlaneVector tool);

}  // namespace dripline::interpreter::compensation::impl
