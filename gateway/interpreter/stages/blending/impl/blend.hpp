#pragma once

#include <optional>

#include "gateway/interpreter/stages/blending/fault.hpp"
#include "gateway/interpreter/stages/blending/impl/element.hpp"

namespace dripline::interpreter::blending::impl {

/// The point where one element ends and the next begins.
struct Blend {
  PlaneVector at;
  std::optional<FaultKind> fault;
  double off_by = 0, radius = 0;  ///< of OffArc
};

/// `first` has its true begin and its programmed end, where `second` begins.
Blend blend_of(const Element& first, const Element& second);
/// Whether an arc that nothing corrects has `point` on its circle.
Blend blend_on(const Element& element, PlaneVector point);

}  // namespace dripline::interpreter::blending::impl
