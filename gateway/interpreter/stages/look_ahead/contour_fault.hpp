#pragma once

#include "gateway/interpreter/core/origin.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter::look_ahead {

/// The rule that a contour breaks, one of the stage's `Kind`s, and where.
template <class Kind>
struct ContourFault {
  Kind kind{};
  Origin origin{};            ///< the element that cannot be carried out
  Origin next{};              ///< the element that showed it; the same one where no other took part
  Length value{}, limit{};    ///< `Kind` states what they are
  bool first_is_arc = false;  ///< the element before the corner
  bool next_is_arc = false;   ///< the element after it
};

}  // namespace dripline::interpreter::look_ahead
