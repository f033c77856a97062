#pragma once

#include <optional>

#include "gateway/interpreter/joining/fault.hpp"
#include "gateway/interpreter/joining/impl/element.hpp"

namespace dripline::interpreter::joining::impl {

/// Where one element goes over into the next.
struct Joint {
  PlaneVector at;
  std::optional<FaultKind> fault;
  double off_by = 0, radius = 0;  ///< of OffArc
};

/// `first` begins where it truly does and ends where the program says; `second` begins there.
Joint joint_of(const Element& first, const Element& second);
/// Whether an arc that nothing corrects has `point` on its circle.
Joint joint_on(const Element& element, PlaneVector point);

}  // namespace dripline::interpreter::joining::impl
