#pragma once

#include <optional>

#include "gateway/interpreter/stages/blending/impl/element.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"

namespace dripline::interpreter::blending::impl {

/// What a rounding or a chamfer makes of a corner.
struct Corner {
  bool is_piece = false;  ///< something is inserted, from `leave` to `arrive`
  bool is_arc = false;
  PlaneVector leave;   ///< on the first element
  PlaneVector arrive;  ///< on the second
  PlaneVector center;
  double sweep = 0;  ///< of an arc: radians, positive to the left
  std::optional<FaultKind> fault;
  double value = 0, limit = 0;  ///< of DoesNotFit
};

/// Both elements end and begin at the corner. Cuts them where the piece leaves and arrives.
Corner shape_corner(const CornerShape& shape, const Policy& policy, Element& first,
                    Element& second);

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
